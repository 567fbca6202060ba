// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray probe` on a scene with exact truth; the forecast of `info`; `devices`.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

using Names = std::set<std::string>;
using nlohmann::json;

class ProbeCommand : public ProgramTest {
 protected:
  ProbeCommand() { make("--views 9"); }
  void make(const std::string& options) const {
    const Result result = run("synth planes -o made --width 64 --height 49 --samples 2 " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  json probe(const std::string& options) const {
    const Result result = run("probe made --json " + options);
    EXPECT_EQ(result.exit_code, 0) << options << ": " << result.err;
    return json::parse(result.out);
  }
};

TEST_F(ProbeCommand, FindsTheDisparityOfThePixel) {
  const FloatMap truth = read_pfm(folder / "made/truth/view_002.pfm");
  int good = 0, all = 0;
  for (int v = 8; v < 49; v += 16)
    for (int u = 8; u < 64; u += 16, ++all) {
      const json found = probe("--view 2 --at " + std::to_string(u) + " " + std::to_string(v));
      good += std::abs(double(found.at("disparity")) - truth(u, v)) < 0.07;
      EXPECT_EQ(found.at("u"), u);
      EXPECT_EQ(found.at("v"), v);
      EXPECT_EQ(found.at("view"), "view_002");
    }
  // A pixel or two may lie on a silhouette.
  EXPECT_GE(good, all - 2) << "of " << all;
}

TEST_F(ProbeCommand, TheNumbersAreThoseOfTheCurve) {
  const json found = probe("--at 30 20");
  const json& scores = found.at("scores");
  const json& hypotheses = found.at("hypotheses");
  ASSERT_EQ(scores.size(), std::size_t(hypotheses.at("count")));
  double best = 0, sum = 0;
  for (const double score : scores) {
    best = std::max(best, score);
    sum += score;
  }
  const double mean = sum / double(scores.size());
  EXPECT_DOUBLE_EQ(found.at("best").at("score"), best);
  EXPECT_NEAR(found.at("mean_score"), mean, 1e-6);
  EXPECT_NEAR(found.at("confidence"), best - mean, 1e-5);
  EXPECT_NEAR(found.at("best").at("disparity"), found.at("disparity"), hypotheses.at("step"));
  const json& runner_up = found.at("runner_up");
  EXPECT_TRUE(runner_up.is_null() || runner_up.at("score") < found.at("best").at("score"));
}

TEST_F(ProbeCommand, EveryViewTellsWhatItSees) {
  // The pixel at the corner leaves the picture in every view on one side.
  const json found = probe("--at 0 24");
  int seen = 0;
  for (const json& sample : found.at("samples")) seen += !sample.at("rgb").is_null();
  EXPECT_EQ(found.at("samples").size(), 9);
  EXPECT_EQ(found.at("seen_by"), seen);
  EXPECT_LT(seen, 9);
  EXPECT_GT(seen, 0);
  // Its own view sees the pixel itself.
  const Image<std::uint16_t> picture = read_picture(folder / "made/view_004.png");
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found.at("samples")[4].at("rgb")[c], picture(0, 24, c) / 255.0, 1e-6);
}

TEST_F(ProbeCommand, WritesItsPicturesAndReplacesThem) {
  for (const std::string views : {"--views 9", "--grid 3x3"}) {
    make(views);
    const Result result = run("probe made --at 30 20 -o out");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const std::string word : {"disparity", "confidence", "hypotheses", "best score",
                                   "runner-up", "mean score", "9 of 9 views"})
      EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
    EXPECT_EQ(names_in("out"), (Names{"epi.png", "gigaray.json", "samples.png", "scores.png"}));
    EXPECT_EQ(json::parse(text_of("out/gigaray.json")), probe("--at 30 20"));
    for (const char* picture : {"epi.png", "samples.png", "scores.png"})
      EXPECT_GT(read_picture(folder / "out" / picture).width(), 100) << picture;
  }
}

TEST_F(ProbeCommand, TellsWhichLevelAndViewDecided) {
  EXPECT_TRUE(probe("--at 30 20").at("decision").is_null());
  const json found = probe("--at 30 20 --decided");
  const json& decision = found.at("decision");
  EXPECT_GE(decision.at("level"), 0);
  EXPECT_TRUE(std::string(decision.at("view")).starts_with("view_"));
  EXPECT_LE(decision.at("bounds")[0], decision.at("bounds")[1]);
  const Result text = run("probe made --at 30 20 --decided");
  EXPECT_NE(text.out.find("decided"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("bounds"), std::string::npos) << text.out;
}

TEST_F(ProbeCommand, APixelThatNoViewCanDecideHasNoDisparity) {
  // With the paper's rule a fifth of the views must see the point, and none but two can.
  const Result result =
      run("probe made --at 0 24 --view 0 --preset paper --disparity 40 50 --json -o out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  EXPECT_TRUE(found.at("disparity").is_null());
  EXPECT_TRUE(found.at("best").is_null());
  EXPECT_EQ(found.at("seen_by"), 0);
  EXPECT_TRUE(names_in("out").contains("scores.png"));
  const std::string text =
      run("probe made --at 0 24 --view 0 --preset paper --disparity 40 50").out;
  EXPECT_NE(text.find("none: too few views"), std::string::npos) << text;
}

using InfoForecast = ProbeCommand;

TEST_F(InfoForecast, TellsMemoryAndDisk) {
  const Result text = run("info made");
  EXPECT_NE(text.out.find("\ndepth      takes "), std::string::npos) << text.out;
  const json much = json::parse(run("info made --json --memory 8").out).at("forecast");
  EXPECT_EQ(much.at("bands"), 1);
  EXPECT_EQ(much.at("disk_mib"), 0);
  EXPECT_GT(much.at("memory_mib"), 0);
  EXPECT_LE(much.at("memory_mib"), 8 * 1024);
}

TEST_F(InfoForecast, ObeysMemoryAndPreset) {
  const json automatic = json::parse(run("info made --json --memory 8").out).at("forecast");
  const json paper =
      json::parse(run("info made --json --memory 8 --preset paper").out).at("forecast");
  EXPECT_NE(automatic.at("memory_mib"), paper.at("memory_mib"));
  expect_failure("info made --preset best", 2, "--preset", "best");
  expect_failure("info made --memory -1", 2, "--memory");
}

TEST_F(InfoForecast, MemoryThatCannotDoIsSaidAndTheRestIsStillTold) {
  const Result text = run("info made --memory 0.001");
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find("depth      can't run: memory of 1 MiB"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("64 × 49 px"), std::string::npos) << text.out;
  const json root = json::parse(run("info made --memory 0.001 --json").out);
  EXPECT_TRUE(root.at("forecast").at("refusal").is_string());
}

class DevicesCommand : public ProgramTest {};

TEST_F(DevicesCommand, ListsTheDevicesWithExactlyOneDefault) {
  const Result text = run("devices"), result = run("devices --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json root = json::parse(result.out);
  ASSERT_FALSE(root.at("devices").empty());
  int defaults = 0;
  for (const json& device : root.at("devices")) {
    defaults += bool(device.at("default"));
    EXPECT_NE(text.out.find(std::string(device.at("name"))), std::string::npos) << text.out;
    EXPECT_TRUE(device.at("tuning").contains("density_score"));
  }
  EXPECT_EQ(defaults, 1);
  EXPECT_NE(text.out.find("(default)"), std::string::npos);
}

TEST_F(DevicesCommand, TellsAndClearsTheKernelCache) {
  const std::string cache = "GIGARAY_CACHE_DIR=$PWD/cache";
  ASSERT_EQ(run("synth planes -o made --views 3 --width 32 --height 24 --samples 2").exit_code, 0);
  ASSERT_EQ(run("depth made -o out --views centre", cache).exit_code, 0);
  const auto programs = [&](const std::string& options) {
    return int(
        json::parse(run("devices --json" + options, cache).out).at("kernel_cache").at("programs"));
  };
  EXPECT_GT(programs(""), 0);
  EXPECT_EQ(programs(" --clear-cache"), 0);
  EXPECT_TRUE(json::parse(run("devices --json", "GIGARAY_CACHE=off").out)
                  .at("kernel_cache")
                  .at("folder")
                  .is_null());
}

}  // namespace
}  // namespace gigaray
