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

/// The panel of `planes` that is nearest, and a pixel of it.
struct Nearest {
  int u = 0, v = 0;
  float value = -99;
  std::string option() const { return " --at " + std::to_string(u) + " " + std::to_string(v); }
};
Nearest nearest_of(const FloatMap& map) {
  Nearest nearest;
  for (int v = 2; v < map.height() - 2; ++v)
    for (int u = 2; u < map.width() - 2; ++u)
      if (map(u, v) > nearest.value) nearest = {u, v, map(u, v)};
  return nearest;
}

TEST_F(SegmentCommand, APixelStandsForItsSurface) {
  const FloatMap map = read_pfm(folder / "depth/disparity.pfm");
  const Nearest nearest = nearest_of(map);
  const std::string at = nearest.option();
  const Result result = run("segment depth -o masks" + at);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json about = json::parse(text_of("masks/gigaray.json"));
  EXPECT_EQ(about.at("unit"), "disparity");
  EXPECT_EQ(about.at("at").at("view"), "view_002");
  EXPECT_NEAR(about.at("at").at("value"), nearest.value, 0.1);
  EXPECT_LT(about.at("least"), nearest.value);
  EXPECT_GT(about.at("least"), nearest.value - 0.5) << "no farther than its surface";
  EXPECT_EQ(mask("masks/mask.png").at<std::uint8_t>(nearest.v, nearest.u), 255);
  EXPECT_NE(result.out.find(" m;"), std::string::npos) << "in metres: " << result.out;
  // The numbers that it prints state the same masks.
  const std::string stated = result.out.substr(result.out.find("--near"));
  ASSERT_EQ(run("segment depth -o again " + stated.substr(0, stated.find('\n'))).exit_code, 0);
  EXPECT_EQ(json::parse(text_of("again/gigaray.json")).at("views"), about.at("views"));
}

TEST_F(SegmentCommand, ToleranceIsDisparityToBothSides) {
  const FloatMap map = read_pfm(folder / "depth/disparity.pfm");
  const Nearest nearest = nearest_of(map);
  const std::string at = nearest.option();
  ASSERT_EQ(run("segment depth -o masks --tolerance 0.25" + at).exit_code, 0);
  const json about = json::parse(text_of("masks/gigaray.json"));
  const double value = about.at("at").at("value");
  EXPECT_NEAR(about.at("least"), value - 0.25, 1e-6);
  EXPECT_NEAR(about.at("most"), value + 0.25, 1e-6);
}

TEST_F(SegmentCommand, OfPhotographsThePointIsFollowedFromViewToView) {
  ASSERT_EQ(run("synth plaster --path arc --extent 1.5 -o walk --views 6 --width 64 --height 48 "
                "--samples 1")
                .exit_code,
            0);
  ASSERT_EQ(run("depth walk -o walked").exit_code, 0);
  ASSERT_EQ(run("segment walked --at 32 24 --tolerance 0.1 -o masks").exit_code, 0);
  const json about = json::parse(text_of("masks/gigaray.json"));
  EXPECT_EQ(about.at("unit"), "inverse depth");
  const double value = about.at("at").at("value");
  EXPECT_NEAR(about.at("least"), 0.9 * value, 1e-6);
  EXPECT_NEAR(about.at("most"), 1.1 * value, 1e-6);
  for (const json& view : about.at("views")) EXPECT_GT(view.at("share"), 0.02) << view;
  expect_refusal("segment walked --at 32 24 --tolerance 1 -o x", 2, "--tolerance 1", "less than 1");
}

TEST_F(SegmentCommand, APixelThatCantBeMeantIsRefused) {
  expect_refusal("segment depth -o x --at 48 3", 2, "--at 48 3", "48 × 37 px");
  expect_refusal("segment depth -o x --at -1 3", 2, "--at -1 3", "outside");
  expect_refusal("segment depth -o x --at 3 1.5", 2, "--at");
  expect_refusal("segment depth -o x --at 3", 2, "--at");
  expect_refusal("segment depth -o x --at 3 3 --near 1 --far 0", 2, "--at", "--near");
  expect_refusal("segment depth -o x --at 3 3 --unit depth", 2, "--at", "--unit");
  expect_refusal("segment depth -o x --at 3 3 --tolerance 0", 2, "--tolerance", "above 0");
  expect_refusal("segment depth -o x --at 3 3 --tolerance nan", 2, "--tolerance");
  expect_refusal("segment depth -o x --tolerance 1", 2, "--tolerance requires --at");
  expect_refusal("segment depth -o x", 2, "--at U V", "--near");
  expect_refusal("segment made -o x --at 3 3", 1, "no result of `gigaray depth`");
  expect_refusal("segment depth -o x --at 3 3 --min-confidence 2", 2, "no estimate");
  FloatMap map = read_pfm(folder / "depth/view_002/disparity.pfm");
  map(3, 3) = std::nanf("");
  write_pfm(folder / "depth/view_002/disparity.pfm", map);
  expect_refusal("segment depth -o x --at 3 3", 2, "no estimate there", "nearest pixel");
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
