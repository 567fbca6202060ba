// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// The options of a run by name: --set, --options, --list-options, and what gigaray.json keeps.
#include <nlohmann/json.hpp>

#include "cli/program_test.h"

namespace gigaray {
namespace {

using nlohmann::json;

class OptionsOfDepth : public ProgramTest {
 protected:
  OptionsOfDepth() { make("planes --views 3 --width 40 --height 31"); }

  void make(const std::string& scene) const {
    const Result result = run("synth " + scene + " -o made --samples 2");
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  void depth(const std::string& options) const {
    const Result result = run("depth made " + options);
    EXPECT_EQ(result.exit_code, 0) << options << ": " << result.err;
  }
  json report(const std::string& name) const {
    return json::parse(text_of(name + "/gigaray.json"));
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
  }
  /// The maps of all views, as bytes.
  std::string maps_of(const std::string& name) const {
    std::string bytes;
    const json root = report(name);
    for (const json& view : root.at("views")) {
      const auto part = std::filesystem::path(name) / std::string(view.at("name"));
      bytes += text_of(part / "disparity.pfm") + text_of(part / "confidence.pfm");
    }
    EXPECT_FALSE(bytes.empty());
    return bytes;
  }
};

TEST_F(OptionsOfDepth, WhatIsSetIsUsedAndRecorded) {
  depth("-o usual --views centre");
  depth("-o set --views centre --set winner.median_radius=0 --set support.sigma_space=3.5");
  EXPECT_NE(maps_of("set"), maps_of("usual"));
  for (const char* key : {"options_asked", "options_used"}) {
    const json options = report("set").at(key);
    EXPECT_EQ(options.at("winner").at("median_radius"), 0) << key;
    EXPECT_EQ(options.at("preset"), "auto") << key;
  }
  EXPECT_EQ(report("set").at("options_asked").at("support").at("sigma_space"), 3.5);
  EXPECT_TRUE(report("set").at("options_asked").at("disparity").is_null());
  EXPECT_EQ(report("set").at("options_used").at("disparity"), (json{-1.0, 1.0}));
}

/// Noisy pictures and an estimated range: a run fills in much that was not asked for.
TEST_F(OptionsOfDepth, ARunIsRepeatedFromItsRecordToTheBit) {
  std::filesystem::remove_all(folder / "made");
  make("garden --views 5 --width 120 --height 90 --noise 0.02");
  json described = json::parse(text_of("made/gigaray.json"));
  described.erase("disparity_range");
  write("made/gigaray.json", described.dump());
  for (const std::string options :
       {"--views 1,2 --set winner.refine=false --set score.unseen=0.3 --partners 3",
        "--preset paper --hypotheses 33 --set winner.median_radius=3 --disparity -1.1 1.3"}) {
    depth("-o first --replace " + options);
    depth("-o second --replace --options first");
    const json first = report("first"), second = report("second");
    EXPECT_EQ(first.at("options_asked"), second.at("options_asked")) << options;
    EXPECT_EQ(first.at("options_used"), second.at("options_used")) << options;
    EXPECT_EQ(first.at("options"), second.at("options")) << options;
    EXPECT_TRUE(maps_of("first") == maps_of("second")) << options;
    const json &asked = first.at("options_asked"), &used = first.at("options_used");
    if (asked.at("preset") == "auto") {
      EXPECT_NE(asked.at("score").at("bandwidth"), used.at("score").at("bandwidth"));
      EXPECT_TRUE(asked.at("disparity").is_null());
    }
  }
}

TEST_F(OptionsOfDepth, FlagsWinOverSetSetOverTheFileTheFileOverThePreset) {
  write("o.json", R"({"preset": "paper", "hypotheses": 20, "most_partners": 7,
                      "winner": {"median_radius": 1, "median_tolerance": 0.2},
                      "edge.radius": 3, "views": [0]})");
  depth(
      "-o out --options o.json --set hypotheses=21 --set winner.median_radius=2 "
      "--set edge.radius=2 --set edge.radius=5 --hypotheses 22");
  json asked = report("out").at("options_asked");
  EXPECT_EQ(asked.at("preset"), "paper");
  EXPECT_EQ(asked.at("score").at("gradient"), false);  // of the preset
  EXPECT_EQ(asked.at("winner").at("median_tolerance"), 0.2);
  EXPECT_EQ(asked.at("most_partners"), 7);
  EXPECT_EQ(asked.at("winner").at("median_radius"), 2);
  EXPECT_EQ(asked.at("edge").at("radius"), 5);
  EXPECT_EQ(asked.at("hypotheses"), 22);
  EXPECT_EQ(report("out").at("views").size(), 1);
  depth("-o out --options o.json --views all --partners 9 --memory 2 --hypotheses 0");
  asked = report("out").at("options_asked");
  EXPECT_EQ(asked.at("most_partners"), 9);
  EXPECT_EQ(asked.at("memory_bytes"), double(std::uint64_t(2) << 30));
  EXPECT_EQ(asked.at("hypotheses"), 0);
  EXPECT_EQ(report("out").at("views").size(), 3);
}

TEST_F(OptionsOfDepth, WhatCannotBeSetIsNamed) {
  const auto expect = [&](const std::string& setting, const std::string& word,
                          const std::string& other = "") {
    expect_refusal("depth made -o out --set " + setting, 2, word, other);
  };
  expect("winner.median_radus=3", "winner.median_radus", "did you mean winner.median_radius?");
  expect("median_radius=3", "did you mean winner.median_radius?");
  expect("qqqqqq=3", "qqqqqq");
  expect("winner.median_radius", "NAME=VALUE");
  expect("winner.median_radius=9", "winner.median_radius is 9", "between 0 and 8");
  expect("winner.median_radius=three", "three", "whole number");
  expect("winner.median_radius=", "winner.median_radius", "whole number");
  expect("score.cubic=perhaps", "score.cubic is perhaps", "true or false");
  expect("preset=paper", "--preset");
  expect("support.radius=0", "support.slanted");
  expect_failure("depth made -o out --set", 2, "--set");
}

TEST_F(OptionsOfDepth, AFileThatIsNoListOfOptionsIsNamed) {
  const auto expect = [&](const std::string& text, const std::string& word) {
    write("o.json", text);
    expect_refusal("depth made -o out --options o.json", 1, "o.json", word);
  };
  expect("", "JSON");
  expect("[]", "JSON");
  expect(R"({"winner": {"median_radus": 3}})", "did you mean winner.median_radius?");
  expect(R"({"winner": {"median_radius": 9}})", "between 0 and 8");
  expect(R"({"winner": {"median_radius": "three"}})", "whole number");
  expect(R"({"winner": [{"median_radius": 3}]})", "winner");
  expect(R"({"preset": "best"})", "best");
  expect(text_of("made/gigaray.json"), "neither");
  expect_refusal("depth made -o out --options nowhere.json", 1, "nowhere.json");
  write("o.json", R"({"preset": "paper"})");
  expect_refusal("depth made -o out --options o.json --preset auto", 2, "--preset auto", "o.json");
}

TEST_F(OptionsOfDepth, TheListOfOptionsNeedsNoInput) {
  const Result result = run("depth --list-options");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("| `winner.median_radius` | integer | 0 … 8 | px | 2 | 5 |"),
            std::string::npos)
      << result.out;
}

}  // namespace
}  // namespace gigaray
