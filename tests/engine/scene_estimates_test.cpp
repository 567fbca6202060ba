// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/scene_estimates.h"

#include <gtest/gtest.h>

#include "support/analytic_field.h"
#include "support/errors.h"

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
  expect_error(ErrorCode::kBadInput, {"--disparity"},
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
