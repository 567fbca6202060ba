// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray encode` and `gigaray decode`.
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;

class EncodeCommand : public ProgramTest {
 protected:
  EncodeCommand() {
    const Result made = run("synth planes -o made --samples 2 --views 5 --width 48 --height 37");
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }
  json encode(const std::string& options = "") const {
    const Result result = run("encode made -o made.grl --json " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  /// Largest difference between the pictures of two folders.
  double difference(const std::string& a, const std::string& b) const {
    double worst = 0;
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / b)) {
      if (entry.path().extension() != ".png") continue;
      const cv::Mat x = cv::imread((folder / a / entry.path().filename()).string());
      const cv::Mat y = cv::imread(entry.path().string());
      EXPECT_EQ(x.size(), y.size());
      if (x.size() == y.size()) worst = std::max(worst, cv::norm(x, y, cv::NORM_INF));
      ++count;
    }
    EXPECT_GT(count, 0);
    return worst;
  }
};

TEST_F(EncodeCommand, DecodeRestoresEveryPixelAndTheRig) {
  const json report = encode();
  EXPECT_EQ(report.at("rays"), 5 * 48 * 37);
  EXPECT_EQ(report.at("file_bytes"), std::filesystem::file_size(folder / "made.grl"));
  EXPECT_LT(report.at("tuples_per_ray"), 0.5);

  const Result result = run("decode made.grl -o back");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "back: 5 views\n");
  EXPECT_EQ(difference("made", "back"), 0);
  const json before = json::parse(text_of("made/gigaray.json"));
  const json after = json::parse(text_of("back/gigaray.json"));
  for (const char* key : {"kind", "width", "height", "rig"})
    EXPECT_EQ(before.at(key), after.at(key)) << key;
  EXPECT_EQ(run("info back").exit_code, 0);
}

TEST_F(EncodeCommand, AFileIsALightField) {
  encode();
  const Result info = run("info made.grl --json");
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(json::parse(info.out).at("views").size(), 5u);
  // The same depth from the file as from the folder.
  ASSERT_EQ(run("depth made -o a --views centre").exit_code, 0);
  ASSERT_EQ(run("depth made.grl -o b --views centre").exit_code, 0);
  EXPECT_TRUE(text_of("a/disparity.pfm") == text_of("b/disparity.pfm"));
}

TEST_F(EncodeCommand, SomeViewsAndRowsAndDepth) {
  encode("--band 8");
  ASSERT_EQ(run("decode made.grl -o all --depth").exit_code, 0);
  const Result result = run("decode made.grl -o part --views 1,3 --rows 10 21 --depth");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in("part"), (std::set<std::string>{"view_001", "view_001.png", "view_003",
                                                     "view_003.png", "gigaray.json"}));
  const cv::Mat whole = cv::imread((folder / "made/view_003.png").string());
  const cv::Mat part = cv::imread((folder / "part/view_003.png").string());
  ASSERT_EQ(part.rows, 11);
  EXPECT_EQ(cv::norm(whole.rowRange(10, 21), part, cv::NORM_INF), 0);
  const FloatMap disparity = read_pfm(folder / "all/view_003/disparity.pfm");
  const FloatMap some = read_pfm(folder / "part/view_003/disparity.pfm");
  const FloatMap truth = read_pfm(folder / "made/truth/view_003.pfm");
  int good = 0;
  for (int v = 0; v < 37; ++v)
    for (int u = 0; u < 48; ++u) {
      good += std::abs(disparity(u, v) - truth(u, v)) < 0.1;
      const bool is_in_part = v >= 10 && v < 21;
      EXPECT_TRUE(!is_in_part || some(u, v - 10) == disparity(u, v));
    }
  EXPECT_GT(good, 0.85 * 48 * 37);
}

TEST_F(EncodeCommand, LossyIsSmallerAndKeepsItsBound) {
  const json lossless = encode();
  const json lossy = encode("--lossy 4");
  EXPECT_LT(lossy.at("file_bytes"), lossless.at("file_bytes"));
  const Result result = run("decode made.grl -o back");
  EXPECT_NE(result.err.find("lossy"), std::string::npos) << result.err;
  EXPECT_LE(difference("made", "back"), 4);
  EXPECT_GT(difference("made", "back"), 0);
}

TEST_F(EncodeCommand, TakesDepthThatIsThere) {
  ASSERT_EQ(run("depth made -o depth").exit_code, 0);
  encode("--depth depth");
  const std::string bytes = text_of("made.grl");
  encode();
  EXPECT_TRUE(text_of("made.grl") == bytes);

  ASSERT_EQ(run("depth made -o some --views 0,1").exit_code, 0);
  expect_refusal("encode made -o x.grl --depth some", 1, "no depth of view view_002");
  expect_refusal("encode made -o x.grl --depth made", 1, "no result of `gigaray depth`");
  expect_refusal("encode made -o x.grl --depth nowhere", 1, "nowhere");
}

TEST_F(EncodeCommand, DamageIsOneLineAndLeavesNothing) {
  encode();
  std::string bytes = text_of("made.grl");
  const auto write = [&](const std::string& name, const std::string& content) {
    std::ofstream(folder / name, std::ios::binary) << content;
  };
  write("short.grl", bytes.substr(0, bytes.size() / 2));
  std::string newer = bytes;
  newer[8] = 7;
  write("newer.grl", newer);
  bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
  write("flipped.grl", bytes);
  write("text.grl", "no light field");
  expect_refusal("decode flipped.grl -o x", 1, "flipped.grl", "is damaged");
  expect_refusal("decode short.grl -o x", 1, "is cut short");
  expect_refusal("decode newer.grl -o x", 1, "version 7", "newer");
  expect_refusal("decode text.grl -o x", 1, "no sparse light field");
  expect_refusal("decode nowhere.grl -o x", 1, "nowhere.grl");
  expect_refusal("decode made.grl -o x --rows 20 20", 2, "--rows");
  expect_refusal("decode made.grl -o x --rows 0 38", 2, "--rows");
  expect_refusal("decode made.grl -o x --views 9", 2, "views 0 … 4");
  expect_refusal("depth flipped.grl -o x", 1, "is damaged");
}

TEST_F(EncodeCommand, PlacesThatCantBeWrittenAreRefused) {
  expect_refusal("encode made -o made", 2, "is a folder");
  expect_refusal("encode made -o nowhere/x.grl", 1, "nowhere/x.grl", "can't be written");
  expect_refusal("encode made -o x.grl --lossy 128", 2, "largest error");
}

TEST_F(EncodeCommand, PhotographsFromAnywhereAreRefused) {
  ASSERT_EQ(run("synth planes -o walk --path walk --samples 2 --views 4 --width 48 --height 37")
                .exit_code,
            0);
  expect_refusal("encode walk -o x.grl", 2, "3D and 4D");
}

TEST_F(EncodeCommand, AFullDiskLeavesNothing) {
  ASSERT_EQ(run("synth planes -o large --samples 1 --views 5 --width 1000 --height 700").exit_code,
            0);
  // Files that PoCL compiles from are smaller than 4000 blocks of 512 bytes.
  expect_refusal("encode large -o x.grl --hypotheses 16", 1, "x.grl", "can't be written",
                 "ulimit -f 4000; trap '' XFSZ; ");
}

TEST_F(EncodeCommand, AnInterruptLeavesNothing) {
  const auto before = names_in(".");
  const pid_t child = start({"encode", "made", "-o", "x.grl"});
  ASSERT_TRUE(wait_until([&] { return text_of(".err").find("level 0") != std::string::npos; }));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && (WEXITSTATUS(status) == 130 || WEXITSTATUS(status) == 0))
      << status << " " << text_of(".err");
  std::set<std::string> after = names_in(".");
  if (WEXITSTATUS(status) == 0) after.erase("x.grl");  // it was done before the signal came
  EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace gigaray
