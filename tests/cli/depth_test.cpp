// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray depth` on a small scene with exact truth. Bad input is in bad_input_test.cpp.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/core/metrics.h"

namespace gigaray {
namespace {

using Names = std::set<std::string>;
using nlohmann::json;

class DepthCommand : public ProgramTest {
 protected:
  static constexpr int kWidth = 48, kHeight = 37;

  DepthCommand() { make("--views 5"); }

  /// A scene in the folder "made".
  void make(const std::string& options, const std::string& size = "--width 48 --height 37") const {
    const Result result = run("synth planes -o made --samples 2 " + size + " " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  void depth(const std::string& options, const std::string& environment = "") const {
    const Result result = run("depth made " + options, environment);
    EXPECT_EQ(result.exit_code, 0) << options << ": " << result.err;
  }
  json report(const std::string& name) const {
    return json::parse(text_of(name + "/gigaray.json"));
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

TEST_F(DepthCommand, WritesEveryViewAndTheCentreAtTopLevel) {
  const Result result = run("depth made -o out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("out: 5 views in ")) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);

  const Names maps{"confidence.pfm", "depth.pfm", "depth.png", "disparity.pfm"};
  Names all = maps;
  all.insert("gigaray.json");
  for (int i = 0; i < 5; ++i) {
    const std::string view = "view_00" + std::to_string(i);
    all.insert(view);
    EXPECT_EQ(names_in("out/" + view), maps);
    const FloatMap disparity = read_pfm(folder / "out" / view / "disparity.pfm");
    const FloatMap confidence = read_pfm(folder / "out" / view / "confidence.pfm");
    ASSERT_EQ(disparity.width(), kWidth);
    ASSERT_EQ(disparity.height(), kHeight);
    EXPECT_TRUE(
        std::all_of(disparity.begin(), disparity.end(), [](float d) { return d >= -1 && d <= 1; }));
    EXPECT_TRUE(std::all_of(confidence.begin(), confidence.end(), [](float c) { return c >= 0; }));
  }
  EXPECT_EQ(names_in("out"), all);
  for (const std::string& map : maps)
    EXPECT_EQ(text_of("out/" + map), text_of("out/view_002/" + map)) << map;
}

TEST_F(DepthCommand, EveryViewIsCloseToTheTruth) {
  depth("-o out");
  // Beside silhouettes, a scene of this size holds little else that could go wrong.
  constexpr double kMostBad = 25, kMostMse = 8;
  for (int i = 0; i < 5; ++i) {
    const std::string view = "view_00" + std::to_string(i);
    const DisparityScores scores =
        score_disparity(read_pfm(folder / "out" / view / "disparity.pfm"),
                        read_pfm(folder / "made/truth" / (view + ".pfm")), 3);
    EXPECT_LT(scores.bad_pix_007, kMostBad) << view;
    EXPECT_LT(scores.mse_x100, kMostMse) << view;
    EXPECT_EQ(scores.filled, 100) << view;
  }
}

TEST_F(DepthCommand, TheReportTellsHowTheMapsWereMade) {
  depth("-o out");
  const json root = report("out");
  EXPECT_EQ(root.at("format"), "gigaray depth");
  EXPECT_EQ(root.at("version"), 1);
  EXPECT_EQ(root.at("centre"), "view_002");
  EXPECT_EQ(root.at("top_level_view"), "view_002");
  EXPECT_EQ(root.at("light_field").at("kind"), "3D");
  EXPECT_EQ(root.at("light_field").at("num_views"), 5);
  EXPECT_TRUE(root.at("light_field").at("rig").at("focal_px").is_number());
  EXPECT_EQ(root.at("options").at("preset"), "auto");
  EXPECT_EQ(root.at("options").at("disparity_range"), (json{-1.0, 1.0}));
  EXPECT_EQ(root.at("views").size(), 5);
  EXPECT_EQ(root.at("views")[1].at("s"), -1.0);
  EXPECT_NE(std::string(root.at("unit")).find("positive is nearer"), std::string::npos);
  EXPECT_FALSE(std::string(root.at("device")).empty());
  EXPECT_GT(root.at("peak_memory_mib"), 1);
  EXPECT_GT(root.at("seconds_total"), 0);
  EXPECT_FALSE(root.at("seconds").empty());
  for (const char* part : {"top_level_view", "all"}) {
    const json& coverage = root.at("coverage").at(part);
    double sum = coverage.at("none");
    for (const double share : coverage.at("per_level")) sum += share;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST_F(DepthCommand, JsonOnStdoutIsTheReport) {
  const Result result = run("depth made -o out --views centre --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out), report("out"));
}

TEST_F(DepthCommand, ThePresetAndItsNumbersAreObeyed) {
  depth("-o out --preset paper --views centre");
  EXPECT_EQ(report("out").at("options").at("preset"), "paper");
  EXPECT_EQ(report("out").at("options").at("hypotheses"), 256);
  depth("-o out --hypotheses 21 --disparity -1.5 1.25 --views centre");
  EXPECT_EQ(report("out").at("options").at("hypotheses"), 21);
  EXPECT_EQ(report("out").at("options").at("disparity_range"), (json{-1.5, 1.25}));
}

TEST_F(DepthCommand, WhatIsLessSureThanAskedForIsLeftOut) {
  depth("-o all --views centre");
  depth("-o sure --views centre --min-confidence 0.9");
  const FloatMap all = read_pfm(folder / "all/disparity.pfm");
  const FloatMap sure = read_pfm(folder / "sure/disparity.pfm");
  const FloatMap confidence = read_pfm(folder / "sure/confidence.pfm");
  EXPECT_EQ(text_of("all/confidence.pfm"), text_of("sure/confidence.pfm"));
  int kept = 0;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      EXPECT_GE(confidence(u, v), 0);
      EXPECT_LE(confidence(u, v), 1);
      EXPECT_EQ(std::isnan(sure(u, v)), confidence(u, v) < 0.9f);
      if (std::isnan(sure(u, v))) continue;
      EXPECT_EQ(sure(u, v), all(u, v));
      ++kept;
    }
  EXPECT_GT(kept, 0);
  EXPECT_LT(kept, kWidth * kHeight);
  EXPECT_NEAR(report("sure").at("kept"), double(kept) / (kWidth * kHeight), 1e-6);
  EXPECT_EQ(report("all").at("kept"), 1);
  expect_refusal("depth made -o none --min-confidence -1", 2, "--min-confidence");
}

TEST_F(DepthCommand, ViewsAreNamedByNameIndexAndRange) {
  const Names top{"confidence.pfm", "depth.pfm", "depth.png", "disparity.pfm", "gigaray.json"};
  const auto with = [&](Names names) {
    names.insert(top.begin(), top.end());
    return names;
  };
  depth("-o out --views centre");
  EXPECT_EQ(names_in("out"), with({"view_002"}));
  depth("-o out --views 0,view_003");
  EXPECT_EQ(names_in("out"), with({"view_000", "view_003"}));
  // Without the centre view, the one nearest to it stands at top level.
  EXPECT_EQ(report("out").at("centre"), "view_002");
  EXPECT_EQ(report("out").at("top_level_view"), "view_003");
  EXPECT_EQ(text_of("out/disparity.pfm"), text_of("out/view_003/disparity.pfm"));
  depth("-o out --views 3-4,1");
  EXPECT_EQ(names_in("out"), with({"view_001", "view_003", "view_004"}));
}

TEST_F(DepthCommand, OtherFormatsHoldTheSameMaps) {
  depth("-o out --views centre --format exr,npy --format png16");
  for (const std::string map : {"disparity", "confidence"}) {
    // As bytes: NaN must stay NaN.
    const FloatMap pfm = read_pfm(folder / "out" / (map + ".pfm"));
    for (const std::string extension : {".exr", ".npy"}) {
      const FloatMap other = read_float_map(folder / "out/view_002" / (map + extension));
      EXPECT_TRUE(
          std::equal(pfm.begin(), pfm.end(), other.begin(), other.end(),
                     [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }))
          << map + extension;
    }
  }
  const FloatMap disparity = read_pfm(folder / "out/disparity.pfm");
  const cv::Mat samples =
      cv::imread((folder / "out/disparity16.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(samples.type(), CV_16UC1);
  const double scale = 2.0 / 65534, offset = -1 - scale;  // of the range -1 … 1, docs/formats.md
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      ASSERT_NEAR(offset + scale * samples.at<std::uint16_t>(v, u), disparity(u, v), scale);
}

TEST_F(DepthCommand, AGridOfSixteenBitsHasDepth) {
  make("--grid 3x3 --bit-depth 16");
  depth("-o out --views centre");
  const DisparityScores scores = score_disparity(read_pfm(folder / "out/disparity.pfm"),
                                                 read_pfm(folder / "made/truth.pfm"), 3);
  EXPECT_LT(scores.bad_pix_007, 30);
  EXPECT_EQ(report("out").at("light_field").at("kind"), "4D");
}

TEST_F(DepthCommand, PlainPicturesNeedNoDescriptionAndNoDirection) {
  // The camera of these pictures moves left as the numbers rise, and nobody says so.
  make("--views 9 --disparity 0.5 3", "--width 96 --height 64");
  std::filesystem::create_directory(folder / "left");
  for (int i = 0; i < 9; ++i)
    std::filesystem::copy_file(folder / "made" / ("view_00" + std::to_string(i) + ".png"),
                               folder / "left" / ("IMG_" + std::to_string(108 - i) + ".png"));
  const Result result = run("depth left -o out --views centre");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("assumed to move to the right"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("direction left, other than assumed"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("disparity range "), std::string::npos) << result.err;
  EXPECT_EQ(report("out").at("pictures_decoded"), 9) << "each once";
  ASSERT_EQ(run("depth left -o small --views centre --max-size 60").exit_code, 0);
  EXPECT_EQ(report("small").at("pictures_decoded"), 9);
  const DisparityScores scores = score_disparity(read_pfm(folder / "out/disparity.pfm"),
                                                 read_pfm(folder / "made/truth.pfm"), 5);
  EXPECT_LT(scores.bad_pix_007, 30);
}

TEST_F(DepthCommand, LittleMemoryGivesTheSameBits) {
  make("--views 21", "--width 300 --height 200");
  // info knows the least memory that will do; it makes the run use files and many bands.
  double too_little = 0.01, enough = 4;
  while (enough - too_little > 1e-3) {
    const double middle = (too_little + enough) / 2;
    const Result info = run("info made --json --memory " + std::to_string(middle));
    ASSERT_EQ(info.exit_code, 0) << info.err;
    (json::parse(info.out).at("forecast").contains("refusal") ? too_little : enough) = middle;
  }
  // The first run may compile kernels, whose memory is not the program's to plan.
  depth("-o much --views 2,10-12 --memory 6");
  EXPECT_EQ(report("much").at("bands"), 1);
  std::filesystem::create_directory(folder / "work");
  depth("-o little --views 2,10-12 --work work --memory " + std::to_string(enough));
  EXPECT_GT(report("little").at("bands"), 4);
  EXPECT_GT(report("little").at("disk_mib"), 1);
  EXPECT_LE(report("little").at("peak_memory_mib"), 1024 * enough);
  EXPECT_TRUE(names_in("work").empty());
  EXPECT_EQ(maps_of("little"), maps_of("much"));
  // What info forecasts is an upper bound: the pictures turn out to be clean.
  expect_refusal("depth made -o none --memory " + std::to_string(0.8 * too_little), 1, "memory of",
                 "give it at least");
}

TEST_F(DepthCommand, RunsWithoutAnyDeviceOnThePlainReference) {
  std::filesystem::create_directory(folder / "none");
  depth("-o out --device reference --views centre --hypotheses 9", "OCL_ICD_VENDORS=$PWD/none");
  EXPECT_TRUE(std::string(report("out").at("device")).starts_with("reference"));
}

TEST_F(DepthCommand, AnOlderResultIsReplacedAndNothingElse) {
  depth("-o out --views all");
  depth("-o out --views centre");
  EXPECT_FALSE(names_in("out").contains("view_000"));
  const std::string before = text_of("made/gigaray.json");
  expect_refusal("depth made -o made", 2, "made", "is what is read too");
  EXPECT_EQ(text_of("made/gigaray.json"), before);
}

}  // namespace
}  // namespace gigaray
