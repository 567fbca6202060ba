// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray view`: what it writes and serves; what the page does with it is tested in viewer/test.
#include <signal.h>

#include <nlohmann/json.hpp>

#include "cli/program_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ViewCommand : public ProgramTest {
 protected:
  ViewCommand() {
    EXPECT_EQ(run("synth planes -o made --samples 2 --views 5 --width 48 --height 37").exit_code,
              0);
    EXPECT_EQ(run("depth made -o depth").exit_code, 0);
  }
};

TEST_F(ViewCommand, APageHoldsAllThatItShows) {
  const Result result = run("view depth -o page.html --truth made");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("page.html: "), std::string::npos);
  EXPECT_NE(result.out.find(" MB"), std::string::npos);
  const std::string page = text_of("page.html");
  const std::string begin = "<script type=\"application/json\" id=\"gigaray-scene\">";
  const auto at = page.find(begin);
  ASSERT_NE(at, std::string::npos);
  const auto scene =
      json::parse(page.substr(at + begin.size(), page.find("</script>", at) - at - begin.size()));
  EXPECT_EQ(scene["title"], "depth");
  EXPECT_EQ(scene["segment"]["result"], "depth");
  for (const auto& view : scene["views"]) {
    EXPECT_NE(page.find("data-name=\"" + view["image"].get<std::string>() + "\""),
              std::string::npos);
    EXPECT_NE(page.find("data-name=\"" + view["maps"]["error"].get<std::string>() + "\""),
              std::string::npos);
  }
}

TEST_F(ViewCommand, AFolderIsForAWebServer) {
  ASSERT_EQ(run("view depth -o site --views centre --compare depth").exit_code, 0);
  EXPECT_EQ(names_in("site"), (std::set<std::string>{"data", "index.html", "scene.json"}));
  const auto scene = json::parse(text_of("site/scene.json"));
  for (const auto& view : scene["views"])
    EXPECT_TRUE(fs::exists(folder / "site/data" / view["image"].get<std::string>()));
  EXPECT_FALSE(scene["compare"]["maps"].empty());
  EXPECT_EQ(run("view depth -o site").exit_code, 0) << "its own output is replaced";
}

TEST_F(ViewCommand, ALightFieldIsShownWithoutDepth) {
  const Result result = run("view made -o made.html");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(text_of("made.html").find("\"segment\":null"), std::string::npos);
}

TEST_F(ViewCommand, CurvesAreThoseOfAllViewsEvenWhereFewHaveDepth) {
  ASSERT_EQ(run("depth made -o few --views 1,3").exit_code, 0);
  const Result result = run("view few -o few");
  EXPECT_EQ(result.exit_code, 2) << "its own input is no place for it";
  ASSERT_EQ(run("view few -o site").exit_code, 0);
  const auto scene = json::parse(text_of("site/scene.json"));
  EXPECT_EQ(scene["views"].size(), 2u);
  ASSERT_FALSE(scene["scores"].is_null());
  EXPECT_EQ(scene["scores"]["view"], scene["top_view"]);
  EXPECT_GT(scene["scores"]["hypotheses"]["count"].get<int>(), 1);
}

TEST_F(ViewCommand, ASparseFileIsAResult) {
  ASSERT_EQ(run("encode made -o made.grl").exit_code, 0);
  const Result result = run("view made.grl -o page.html");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(text_of("page.html").find("view_0000.value"), std::string::npos);
}

TEST_F(ViewCommand, TheServerTellsItsAddressAndEndsByCtrlC) {
  fs::remove(folder / ".out");
  const pid_t child = start({"view", "depth"});
  ASSERT_TRUE(wait_until([&] { return text_of(".out").find('\n') != std::string::npos; }));
  EXPECT_TRUE(text_of(".out").starts_with("http://127.0.0.1:")) << text_of(".out");
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << text_of(".err");
}

TEST_F(ViewCommand, WhatDoesNotGoTogetherIsSaidInOneLine) {
  expect_failure("view depth -o a.html --port 80", 2, "--port", "--output");
  expect_failure("view made -o a.html --compare depth", 2, "--compare", "made");
  expect_failure("view made -o a.html --min-confidence 0.5", 2, "--min-confidence");
  expect_refusal("view depth -o a.html --views nobody", 2, "nobody");
  expect_refusal("view depth -o a.html --cloud no.ply", 1, "no.ply");
  expect_refusal("view depth -o a.html --truth depth", 1, "depth", "truth");
  expect_refusal("view depth -o depth", 2, "depth");
  expect_refusal("view nothing -o a.html", 1, "nothing");
  fs::remove(folder / "depth/view_002/disparity.pfm");
  expect_refusal("view depth -o a.html", 1, "view_002");
}

}  // namespace
}  // namespace gigaray
