// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The whole method on posed cameras, whose depth is known exactly.
#include <gtest/gtest.h>

#include <set>

#include "engine/cache_fixture.h"
#include "gigaray/engine/scene_estimates.h"
#include "support/depth_result.h"
#include "support/errors.h"
#include "support/memory_limits.h"
#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

constexpr int kWidth = 151, kHeight = 115;

PosedField walk(int views = 9) {
  const std::vector<View> grid = grid_of_views(3, views / 3);
  return posed_field(cameras_around(grid, kWidth, kHeight), grid);
}

DepthOptions few_hypotheses(const std::string& preset) {
  DepthOptions options = preset_options(preset);
  options.hypotheses = 64;
  return options;
}

Reconstruction run(const LightField& light_field, const DepthOptions& options,
                   const std::string& backend = "opencl") {
  return reconstruct(light_field, options, {backend, ""}, RunControl{});
}

struct Accuracy {
  double within = 0;  ///< share of all pixels whose depth is right within the bound
  double known = 0;
};

/// bound: relative error of depth. The whole range moves a point by 3 to 6 px, and along the
/// borders some rays are seen by no other camera: the tests ask for nine pixels of ten.
Accuracy accuracy_of(const FloatMap& inverse_depth, const FloatMap& truth, double bound) {
  Accuracy result;
  for (int v = 0; v < truth.height(); ++v)
    for (int u = 0; u < truth.width(); ++u) {
      const float w = inverse_depth(u, v);
      if (std::isnan(w)) continue;
      result.known += 1;
      result.within += std::abs(1 / w - truth(u, v)) < bound * truth(u, v);
    }
  const double pixels = double(truth.size());
  return {result.within / pixels, result.known / pixels};
}

class Unstructured : public testing::TestWithParam<const char*> {};

TEST_P(Unstructured, EveryViewGetsItsDepth) {
  const PosedField field = walk();
  Reconstruction result = run(field.light_field, few_hypotheses(GetParam()));
  ASSERT_EQ(result.views().size(), field.depth.size());
  for (const int view : result.views()) {
    const Accuracy accuracy = accuracy_of(result.view(view).disparity, field.depth[view], 0.01);
    EXPECT_GT(accuracy.within, 0.9) << "view " << view;
    EXPECT_EQ(accuracy.known, 1) << "view " << view;
  }
}

TEST_P(Unstructured, ReferenceAndOpenClAgree) {
  const PosedField field = walk(6);
  DepthOptions options = few_hypotheses(GetParam());
  options.hypotheses = 24;
  options.views = {2, 3};
  Reconstruction expected = run(field.light_field, options, "reference");
  Reconstruction actual = run(field.light_field, options);
  for (const int view : expected.views()) {
    const FloatMap a = expected.view(view).disparity, b = actual.view(view).disparity;
    const double step = (expected.cameras()[view].inverse_depth->max -
                         expected.cameras()[view].inverse_depth->min) /
                        (options.hypotheses - 1);
    long same = 0;
    for (std::size_t i = 0; i < a.size(); ++i) same += std::abs(a.data()[i] - b.data()[i]) < step;
    EXPECT_GT(double(same), 0.995 * double(a.size())) << "view " << view;
  }
}

TEST_P(Unstructured, MemoryDoesNotChangeTheResult) {
  const PosedField field = walk();
  DepthOptions options = few_hypotheses(GetParam());
  options.hypotheses = 24;
  options.views = {4, 0};
  options.memory_bytes = 4e9;
  ASSERT_EQ(forecast(field.light_field, options).bands, 1);
  Reconstruction whole = run(field.light_field, options);
  const DepthResult expected = all_of(whole);
  const double least = least_limit_by_trial(field.light_field, options);
  std::set<int> bands;
  for (double more = 0; more < 16e6 && bands.size() < 3; more = more * 1.6 + 1e5) {
    options.memory_bytes = least + more;
    const Forecast plan = forecast(field.light_field, options);
    if (!bands.insert(plan.bands).second) continue;
    Reconstruction parts = run(field.light_field, options);
    expect_identical(expected, all_of(parts), std::to_string(plan.bands) + " bands");
  }
  EXPECT_GE(bands.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Presets, Unstructured, testing::Values("auto", "paper"));

TEST(UnstructuredRange, IsFoundInThePicturesWhereTheInputStatesNone) {
  PosedField field = walk();
  const std::vector<Camera> stated = field.light_field.cameras;
  for (Camera& camera : field.light_field.cameras) camera.inverse_depth.reset();
  LightField estimated = field.light_field;
  estimate_inverse_depths(estimated, RunControl{}, true);
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const InverseDepthRange range = *estimated.cameras[i].inverse_depth;
    EXPECT_LT(range.min, 1 / 10.0) << i;
    EXPECT_GT(range.max, 1 / 8.7) << i;
    EXPECT_LT(range.max - range.min, 0.2) << i;
  }
  Reconstruction result = run(field.light_field, few_hypotheses("auto"));
  EXPECT_GT(accuracy_of(result.view(4).disparity, field.depth[4], 0.01).within, 0.9);
}

TEST(UnstructuredRange, IsNotLostWhenTwoCamerasStandInOnePlace) {
  PosedField field = walk();
  std::vector<Camera>& cameras = field.light_field.cameras;
  cameras[1].translation =
      cameras[1].rotation * (-cameras[0].position() + Eigen::Vector3d(1e-15, 0, 0));
  for (Camera& camera : cameras) camera.inverse_depth.reset();
  estimate_inverse_depths(field.light_field, RunControl{}, false);
  for (const Camera& camera : cameras) EXPECT_LT(camera.inverse_depth->max, 100);
}

TEST(UnstructuredRange, IsTheUsersWhereStated) {
  const PosedField field = walk(6);
  DepthOptions options = few_hypotheses("auto");
  options.views = {2};
  options.disparity = DisparityRange{0.08, 0.13};
  Reconstruction result = run(field.light_field, options);
  EXPECT_EQ(result.hypotheses().min, 0.08);
  EXPECT_EQ(result.hypotheses().max, 0.13);
  options.disparity = DisparityRange{-0.1, 0.1};
  expect_error(ErrorCode::kInvalidArgument, {"inverse depth", "negative"},
               [&] { run(field.light_field, options); });
}

TEST(UnstructuredViews, OfOtherPlacesThanTheCamerasAreRefused) {
  PosedField field = walk(6);
  field.light_field.cameras.pop_back();
  expect_error(ErrorCode::kBadInput, {"camera", "every view"},
               [&] { run(field.light_field, few_hypotheses("auto")); });
}

TEST(UnstructuredViews, WithoutOverlapAreRefused) {
  PosedField field = walk(6);
  for (std::size_t i = 0; i < field.light_field.cameras.size(); ++i) {
    Camera& camera = field.light_field.cameras[i];
    camera.rotation =
        Eigen::AngleAxisd(1.0 * double(i), Eigen::Vector3d::UnitY()).toRotationMatrix();
  }
  expect_error(ErrorCode::kBadInput, {"no depth", "30 %", "40 degrees"},
               [&] { run(field.light_field, few_hypotheses("auto")); });
}

TEST(UnstructuredViews, AloneHaveNoDepthAndAreNamed) {
  PosedField field = walk(6);
  Camera& camera = field.light_field.cameras[5];
  camera.rotation = Eigen::AngleAxisd(3, Eigen::Vector3d::UnitY()).toRotationMatrix();
  std::string said;
  RunControl control;
  control.on_message = [&](const std::string& message) { said += message + "\n"; };
  DepthOptions options = few_hypotheses("auto");
  options.views = {2, 5};
  Reconstruction result = reconstruct(field.light_field, options, {"opencl", ""}, control);
  EXPECT_NE(said.find("view view5 gets no depth"), std::string::npos) << said;
  const FloatMap disparity = result.view(5).disparity;
  EXPECT_TRUE(
      std::all_of(disparity.begin(), disparity.end(), [](float d) { return std::isnan(d); }));
  EXPECT_GT(accuracy_of(result.view(2).disparity, field.depth[2], 0.01).within, 0.85);
}

TEST(UnstructuredMasks, HaveNoDepthAndAddNothingToOthers) {
  const std::vector<View> grid = grid_of_views(3, 3);
  const auto cameras = cameras_around(grid, kWidth, kHeight);
  // A bar that stands in every picture at the same place, as the strap of a camera would.
  const auto bar = [](int u, int) { return u >= 60 && u < 75; };
  const PosedField field = posed_field(cameras, grid, bar);
  Reconstruction result = run(field.light_field, few_hypotheses("auto"));
  for (const int view : result.views()) {
    const ViewDepth depth = result.view(view);
    long right = 0, shown = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        if (bar(u, v)) {
          ASSERT_TRUE(std::isnan(depth.disparity(u, v))) << u << " " << v;
          continue;
        }
        ++shown;
        right += std::abs(1 / depth.disparity(u, v) - field.depth[view](u, v)) <
                 0.01 * field.depth[view](u, v);
      }
    EXPECT_GT(double(right), 0.88 * double(shown)) << "view " << view;
  }
}

TEST(UnstructuredPartners, FewAreEnough) {
  const PosedField field = walk();
  DepthOptions options = few_hypotheses("auto");
  options.views = {4};
  options.most_partners = 4;
  Reconstruction result = run(field.light_field, options);
  EXPECT_GT(accuracy_of(result.view(4).disparity, field.depth[4], 0.01).within, 0.87);
}

TEST(UnstructuredProbe, SpeaksInInverseDepth) {
  const PosedField field = walk();
  const ScoreCurve curve =
      probe(field.light_field, few_hypotheses("auto"), {"opencl", ""}, 4, 30, 20, RunControl{});
  EXPECT_EQ(curve.samples.size(), 9u);
  EXPECT_NEAR(1 / curve.disparity, field.depth[4](30, 20), 0.02 * field.depth[4](30, 20));
  EXPECT_EQ(curve.hypotheses.min, field.light_field.cameras[4].inverse_depth->min);
}

}  // namespace
}  // namespace gigaray::testing_support
