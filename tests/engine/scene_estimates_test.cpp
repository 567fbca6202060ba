// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/scene_estimates.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/analytic_field.h"
#include "support/errors.h"
#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

AnalyticField two_planes(const std::vector<View>& views, double far, double near, int width = 161,
                         int height = 95, int bit_depth = 8) {
  Layer front{near, 7};
  front.left = 0.2 * width;
  front.right = 0.5 * width;
  return analytic_field(width, height, views, {{far, 3}, front}, bit_depth);
}

TEST(RangeEstimate, HoldsAllPlanesAndLittleMore) {
  const RunControl control;
  struct Case {
    std::vector<View> views;
    double far, near;
  };
  for (const Case& test : {Case{row_of_views(9), 0.4, 1.7}, Case{grid_of_views(5, 5), -0.9, 1.1},
                           Case{irregular_grid(), 0.5, 2.0}, Case{row_of_views(2), 1, 4}}) {
    const AnalyticField field = two_planes(test.views, test.far, test.near);
    const RangeEstimate estimate = estimate_disparity_range(field.light_field, control);
    const double span = test.near - test.far;
    EXPECT_LE(estimate.range.min, test.far);
    EXPECT_GE(estimate.range.max, test.near);
    EXPECT_GT(estimate.range.min, test.far - 0.7 * span);
    EXPECT_LT(estimate.range.max, test.near + 0.7 * span);
    EXPECT_EQ(estimate.negative_share > 0.1, test.far < 0);
    EXPECT_GT(estimate.samples, 100);
  }
}

TEST(RangeEstimate, LargePicturesAreSearchedSmall) {
  const RunControl control;
  const AnalyticField field = two_planes(row_of_views(5), 2, 7, 801, 161, 16);
  const RangeEstimate estimate = estimate_disparity_range(field.light_field, control);
  EXPECT_LE(estimate.range.min, 2.1);
  EXPECT_GE(estimate.range.max, 6.9);
  EXPECT_LT(estimate.range.max - estimate.range.min, 12);
}

TEST(RangeEstimate, PicturesWithoutTextureAskForARange) {
  const RunControl control;
  const AnalyticField flat = analytic_field(93, 61, row_of_views(5), {{0.5, 1, 0}});
  expect_error(ErrorCode::kBadInput, {"DepthOptions::disparity"},
               [&] { estimate_disparity_range(flat.light_field, control); });
}

TEST(RangeEstimate, CanBeCancelled) {
  RunControl control;
  control.cancel();
  const AnalyticField field = two_planes(row_of_views(5), 0.4, 1.7);
  expect_error(ErrorCode::kCancelled, {},
               [&] { estimate_disparity_range(field.light_field, control); });
}

TEST(NoiseEstimate, GrowsWithTheNoise) {
  const RunControl control;
  for (const auto& views : {row_of_views(9), grid_of_views(3, 3)}) {
    NoiseEstimate last{-1, -1};
    for (const double noise : {0.0, 0.01, 0.03, 0.08}) {
      const AnalyticField field = analytic_field(93, 61, views, {{0.5}}, 16, noise);
      const NoiseEstimate estimate = estimate_noise(field.light_field, {-1, 2, 31}, control);
      EXPECT_GT(estimate.colour, last.colour) << noise;
      EXPECT_GT(estimate.gradient, last.gradient) << noise;
      // Two noisy colours of three channels are sqrt(6) sigma apart; the best hypothesis is less.
      EXPECT_LT(estimate.colour, 3 * noise + 0.02);
      last = estimate;
    }
  }
}

TEST(NoiseEstimate, BandwidthsGrowWithItFromALeastValue) {
  DepthOptions clean = auto_options(), noisy = auto_options();
  apply_noise({0, 0}, clean);
  apply_noise({0.05, 0.02}, noisy);
  EXPECT_EQ(clean.score.bandwidth, kLeastBandwidth);
  EXPECT_EQ(clean.score.gradient_bandwidth, kLeastGradientBandwidth);
  EXPECT_GT(noisy.score.bandwidth, clean.score.bandwidth);
  EXPECT_GT(noisy.score.gradient_bandwidth, clean.score.gradient_bandwidth);
  EXPECT_GT(noisy.support.sigma_colour, clean.support.sigma_colour);
  EXPECT_NO_THROW(noisy.check());
}

/// Pictures of which one is replaced.
class WithStray : public PixelSource {
 public:
  WithStray(std::shared_ptr<const PixelSource> all, int stray, Image<std::uint16_t> picture)
      : all_(std::move(all)), stray_(stray), picture_(std::move(picture)) {}
  Image<std::uint16_t> read(int view) const override {
    return view == stray_ ? picture_ : all_->read(view);
  }
  int bit_depth() const override { return all_->bit_depth(); }

 private:
  std::shared_ptr<const PixelSource> all_;
  int stray_;
  Image<std::uint16_t> picture_;
};

/// A walk of 15 photographs, the middle one of which shows something else on demand.
LightField walk_of_15() {
  const std::vector<View> views = grid_of_views(5, 3);
  PosedField field = posed_field(cameras_around(views, 121, 91), views);
  for (Camera& camera : field.light_field.cameras) camera.inverse_depth = {1 / 12.0, 1 / 7.0};
  return field.light_field;
}

void expect_same_bandwidths(const NoiseEstimate& noise, const NoiseEstimate& wanted) {
  DepthOptions options = auto_options(), as_wanted = auto_options();
  apply_noise(noise, options);
  apply_noise(wanted, as_wanted);
  constexpr double kOtherViewsAsked = 0.2;  // a view less moves the places of those that tell
  EXPECT_NEAR(options.score.bandwidth, as_wanted.score.bandwidth,
              kOtherViewsAsked * as_wanted.score.bandwidth);
  EXPECT_NEAR(options.score.gradient_bandwidth, as_wanted.score.gradient_bandwidth,
              kOtherViewsAsked * as_wanted.score.gradient_bandwidth);
}

TEST(NoiseOfAWalk, AStrayPhotographInItsMiddleChangesNothing) {
  const RunControl control;
  const HypothesisRange hypotheses{0, 1, 64};
  const LightField walk = walk_of_15();
  const int centre = centre_view(walk);
  const NoiseEstimate wanted = estimate_noise(without(walk, {centre}), hypotheses, control);
  EXPECT_GT(wanted.lead, 2);

  // Something else: fine noise of other colours.
  LightField stray = walk;
  Image<std::uint16_t> other(walk.width, walk.height, 3);
  std::uint32_t state = 1;
  for (std::uint16_t& value : other) value = std::uint16_t((state = state * 1664525 + 1) >> 24);
  for (const int place : {centre, 6}) {  // every second partner is asked, the centre is none
    stray.pixels = std::make_shared<WithStray>(walk.pixels, place, other);
    expect_same_bandwidths(estimate_noise(stray, hypotheses, control), wanted);
  }

  // The right picture, but its camera looks another way: it has no partners.
  LightField turned = walk;
  Camera& camera = turned.cameras[centre];
  camera.rotation = Eigen::AngleAxisd(2, Eigen::Vector3d::UnitY()) * camera.rotation;
  camera.translation = Eigen::AngleAxisd(2, Eigen::Vector3d::UnitY()) * camera.translation;
  expect_same_bandwidths(estimate_noise(turned, hypotheses, control), wanted);

  // The right picture in the wrong place: it has partners, and nothing fits.
  LightField moved = walk;
  moved.cameras[centre].translation += Eigen::Vector3d(0.7, -0.9, 0);
  expect_same_bandwidths(estimate_noise(moved, hypotheses, control), wanted);
}

TEST(NoiseOfAWalk, APictureOfAnotherExposureIsNoStray) {
  const RunControl control;
  const HypothesisRange hypotheses{0, 1, 64};
  const LightField walk = walk_of_15();
  constexpr int kAsked = 6;  // of every second partner
  Image<std::uint16_t> darker = walk.pixels->read(kAsked);
  for (std::uint16_t& value : darker) value = std::uint16_t(0.5 * value);
  LightField exposed = walk;
  exposed.pixels = std::make_shared<WithStray>(walk.pixels, kAsked, darker);
  // Those that are compared with it are farther off, which bandwidths must allow.
  EXPECT_GT(estimate_noise(exposed, hypotheses, control).colour,
            1.3 * estimate_noise(walk, hypotheses, control).colour);
}

TEST(NoiseOfAWalk, WithoutAnythingInCommonThereIsNoneAndThatIsSaid) {
  RunControl control;
  std::string messages;
  control.on_message = [&](const std::string& text) { messages += text; };
  LightField walk = walk_of_15();
  for (int i = 0; i < walk.num_views(); ++i)
    walk.cameras[i].rotation =
        Eigen::AngleAxisd(2 * i, Eigen::Vector3d::UnitY()) * walk.cameras[i].rotation;
  const LightField apart = without(walk, {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14});
  const NoiseEstimate noise = estimate_noise(apart, {0, 1, 16}, control);
  DepthOptions options = auto_options();
  apply_noise(noise, options);
  EXPECT_EQ(options.score.bandwidth, kLeastBandwidth);
  EXPECT_EQ(options.score.gradient_bandwidth, kLeastGradientBandwidth);
  EXPECT_NE(messages.find("no view agrees"), std::string::npos);
}

TEST(NoiseOfARow, IsThatOfItsCentreUnlessThatShowsSomethingElse) {
  const RunControl control;
  const AnalyticField field = analytic_field(93, 61, row_of_views(9), {{0.5}}, 8, 0.02);
  const NoiseEstimate noise = estimate_noise(field.light_field, {-1, 2, 31}, control);
  EXPECT_EQ(noise.view, centre_view(field.light_field));
  LightField stray = field.light_field;
  stray.pixels = std::make_shared<WithStray>(stray.pixels, noise.view,
                                             Image<std::uint16_t>(stray.width, stray.height, 3));
  const NoiseEstimate found = estimate_noise(stray, {-1, 2, 31}, control);
  EXPECT_NE(found.view, noise.view);
  EXPECT_LT(found.colour, 2 * noise.colour + 0.05);
}

TEST(RayDoubt, ComesWithNoiseAndWithFewViews) {
  const NoiseEstimate weak{0.005, 0.001, 1.5}, strong{0.04, 0.01, 1.5};
  EXPECT_EQ(ray_doubt(weak, kLeadOfOwnPixel, 80), 0);
  EXPECT_EQ(ray_doubt(weak, kLeadOfOwnPixel, 16), 0);
  EXPECT_EQ(ray_doubt(weak, 0.5, 80), 1);
  EXPECT_EQ(ray_doubt(strong, 0.5, 80), 0);
  EXPECT_EQ(ray_doubt({0.0005, 0, 0.5}, 0.5, 80), 0) << "no noise, no texture";
  EXPECT_EQ(ray_doubt(strong, 12, 1), 1);
  EXPECT_GT(ray_doubt(weak, 2.3, 80), 0);
  EXPECT_LT(ray_doubt(weak, 2.3, 80), 1);
  EXPECT_GT(ray_doubt(strong, 12, 2), ray_doubt(strong, 12, 4));
  EXPECT_GT(ray_doubt(strong, 12, 4), 0);
}

TEST(RayDoubt, WidensTheSupportInEvenSteps) {
  const DepthOptions usual = auto_options();
  DepthOptions sure = usual, halfway = usual, doubtful = usual, paper = paper_options();
  apply_doubt(0, sure);
  apply_doubt(0.4, halfway);
  apply_doubt(1, doubtful);
  apply_doubt(1, paper);
  EXPECT_EQ(sure.support.radius, usual.support.radius);
  EXPECT_EQ(sure.support.sigma_space, usual.support.sigma_space);
  EXPECT_EQ(sure.score.gradient_share, usual.score.gradient_share);
  EXPECT_EQ(halfway.support.radius, 6);
  EXPECT_EQ(halfway.support.sigma_space, 6);
  EXPECT_EQ(doubtful.support.radius, usual.support.radius_in_doubt);
  EXPECT_EQ(doubtful.score.gradient_share, usual.score.gradient_share_in_doubt);
  EXPECT_EQ(paper.support.radius, 0);
  for (const DepthOptions& options : {sure, halfway, doubtful}) EXPECT_NO_THROW(options.check());
}

}  // namespace
}  // namespace gigaray::testing_support
