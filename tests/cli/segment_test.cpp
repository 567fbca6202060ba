// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray segment` on a scene with exact truth.
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;

class SegmentCommand : public ProgramTest {
 protected:
  SegmentCommand() {
    EXPECT_EQ(run("synth planes -o made --samples 2 --views 5 --width 48 --height 37").exit_code,
              0);
    EXPECT_EQ(run("depth made -o depth").exit_code, 0);
  }
  cv::Mat mask(const std::string& path) const {
    return cv::imread((folder / path).string(), cv::IMREAD_UNCHANGED);
  }
};

TEST_F(SegmentCommand, MasksOfAllViewsAreThoseOfTheMaps) {
  const FloatMap first = read_pfm(folder / "depth/view_000/disparity.pfm");
  std::vector<float> sorted(first.begin(), first.end());
  std::sort(sorted.begin(), sorted.end());
  const float near = sorted.back(), far = sorted[sorted.size() / 2];
  const Result result = run("segment depth -o masks --near " + std::to_string(near + 0.1) +
                            " --far " + std::to_string(far));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (int view = 0; view < 5; ++view) {
    const std::string name = "view_00" + std::to_string(view);
    const FloatMap map = read_pfm(folder / "depth" / name / "disparity.pfm");
    const cv::Mat found = mask("masks/" + name + "/mask.png");
    ASSERT_EQ(found.type(), CV_8U);
    int wrong = 0;
    for (int v = 0; v < 37; ++v)
      for (int u = 0; u < 48; ++u)
        wrong += found.at<std::uint8_t>(v, u) !=
                 (map(u, v) >= float(std::stod(std::to_string(far))) ? 255 : 0);
    EXPECT_EQ(wrong, 0);
  }
  const json about = json::parse(text_of("masks/gigaray.json"));
  EXPECT_EQ(about.at("unit"), "disparity");
  EXPECT_EQ(about.at("views").size(), 5u);
}

TEST_F(SegmentCommand, TheOrderOfNearAndFarTellsDisparityFromDepth) {
  ASSERT_EQ(run("segment depth -o a --near 100000 --far 0.0001 --views centre").exit_code, 0);
  EXPECT_EQ(json::parse(text_of("a/gigaray.json")).at("unit"), "disparity");
  ASSERT_EQ(run("segment depth -o b --near 0.0001 --far 100000 --views centre").exit_code, 0);
  const json about = json::parse(text_of("b/gigaray.json"));
  EXPECT_EQ(about.at("unit"), "depth");
  const FloatMap depth = read_pfm(folder / "depth/depth.pfm");
  const auto known = std::count_if(depth.begin(), depth.end(), [](float z) { return z > 0; });
  EXPECT_EQ(about.at("views")[0].at("share"), double(known) / double(depth.size()));
}

TEST_F(SegmentCommand, SoftEdgesAsPngAndExr) {
  const Result result =
      run("segment depth -o masks --near 99 --far 0.6 --soft --radius 3 --format exr");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const cv::Mat matte = mask("masks/view_002/matte.png");
  ASSERT_EQ(matte.type(), CV_16U);
  const FloatMap exr = read_exr(folder / "masks/view_002/matte.exr");
  int soft = 0;
  for (int v = 0; v < 37; ++v)
    for (int u = 0; u < 48; ++u) {
      EXPECT_NEAR(matte.at<std::uint16_t>(v, u) / 65535.0, exr(u, v), 1e-4);
      soft += exr(u, v) > 0.02 && exr(u, v) < 0.98;
    }
  EXPECT_GT(soft, 0);
}

TEST_F(SegmentCommand, WhatCantBeMeantIsRefused) {
  expect_refusal("segment depth -o x --near 1 --far 1", 2, "the same");
  expect_refusal("segment depth -o x --near 1 --far 2 --unit disparity", 2, "larger");
  expect_refusal("segment depth -o x --near 2 --far 1 --unit depth", 2, "less");
  expect_refusal("segment depth -o x --near -2 --far 1", 2, "negative");
  expect_refusal("segment made -o x --near 2 --far 1", 1, "no result of `gigaray depth`");
  expect_refusal("segment nowhere -o x --near 2 --far 1", 1, "nowhere");
  expect_refusal("segment depth -o x --near 2 --far 1 --views 7", 2, "views 0 … 4");
  expect_refusal("segment depth -o made --near 2 --far 1", 2, "name another folder");
  expect_failure("segment depth -o x --near 2", 2, "--far");
}

TEST_F(SegmentCommand, DistancesNeedARig) {
  // The same pictures without a rig.
  std::filesystem::create_directory(folder / "bare");
  for (int i = 0; i < 5; ++i) {
    const std::string name = "view_00" + std::to_string(i) + ".png";
    std::filesystem::copy(folder / "made" / name, folder / "bare" / name);
  }
  ASSERT_EQ(run("depth bare -o bare_depth --views centre").exit_code, 0);
  expect_refusal("segment bare_depth -o x --near 1 --far 2", 2, "no depth in scene units");
}

TEST_F(SegmentCommand, MissingAndDamagedMapsAreNamed) {
  std::filesystem::remove(folder / "depth/view_003/disparity.pfm");
  expect_refusal("segment depth -o x --near 2 --far 1", 1, "view_003/disparity.pfm");
  std::filesystem::copy(folder / "made/truth/view_003.pfm",
                        folder / "depth/view_003/disparity.pfm");
  EXPECT_EQ(run("segment depth -o x --near 2 --far 1").exit_code, 0);
  std::filesystem::resize_file(folder / "depth/view_003/disparity.pfm", 100);
  expect_refusal("segment depth -o y --near 2 --far 1", 1, "view_003/disparity.pfm");
  // Soft edges need the pictures.
  std::filesystem::rename(folder / "made", folder / "moved");
  expect_refusal("segment depth -o y --near 2 --far 1 --soft --views 0", 1, "--input");
  EXPECT_EQ(run("segment depth -o y --near 2 --far 1 --soft --views 0 --input moved").exit_code, 0);
}

}  // namespace
}  // namespace gigaray
