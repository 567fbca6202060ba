// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gigaray {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatMap row_of(std::initializer_list<float> values) {
  FloatMap map(int(values.size()), 1);
  std::copy(values.begin(), values.end(), map.begin());
  return map;
}

TEST(Metrics, ExactEstimateScoresZero) {
  const FloatMap map(7, 5, 1, 0.25f);
  const DisparityScores scores = score_disparity(map, map, 1);
  EXPECT_EQ(scores.scored, 15);
  EXPECT_EQ(scores.bad_pix_001, 0);
  EXPECT_EQ(scores.mse_x100, 0);
  EXPECT_EQ(scores.q25_x100, 0);
  EXPECT_EQ(scores.filled, 100);
}

TEST(Metrics, ThresholdsCountWhatExceedsThem) {
  // Errors 0, 1/64, 1/32, 1/16, 1/8: exact in float.
  const FloatMap estimate = row_of({1, 1.015625f, 0.96875f, 1.0625f, 0.875f});
  const FloatMap truth(5, 1, 1, 1.0f);
  const DisparityScores scores = score_disparity(estimate, truth, 0);
  EXPECT_DOUBLE_EQ(scores.bad_pix_007, 20);
  EXPECT_DOUBLE_EQ(scores.bad_pix_003, 60);
  EXPECT_DOUBLE_EQ(scores.bad_pix_001, 80);
  EXPECT_DOUBLE_EQ(scores.q25_x100, 100 / 64.0);
  EXPECT_DOUBLE_EQ(scores.mse_x100, 100 * (1 + 4 + 16 + 64) / 4096.0 / 5);
}

TEST(Metrics, Q25InterpolatesBetweenSortedErrors) {
  // Place 0.25 * 3 of the errors 0, 0.5, 1, 2.
  const DisparityScores scores =
      score_disparity(row_of({2, 0, 1, 0.5f}), FloatMap(4, 1, 1, 0.0f), 0);
  EXPECT_DOUBLE_EQ(scores.q25_x100, 37.5);
}

TEST(Metrics, MissingEstimatesAreBadButNotInTheMeans) {
  const DisparityScores scores =
      score_disparity(row_of({0.5f, kNaN, kInfinity, 0}), FloatMap(4, 1, 1, 0.0f), 0);
  EXPECT_DOUBLE_EQ(scores.filled, 50);
  EXPECT_DOUBLE_EQ(scores.bad_pix_007, 75);
  EXPECT_DOUBLE_EQ(scores.mse_x100, 12.5);
  EXPECT_DOUBLE_EQ(scores.q25_x100, 12.5);
}

TEST(Metrics, UnknownTruthBorderAndMaskAreLeftOut) {
  FloatMap estimate(7, 5), truth(7, 5);
  estimate(0, 0) = 9;  // inside the border
  estimate(2, 2) = 9;
  truth(2, 2) = kNaN;
  estimate(3, 2) = 9;
  Mask mask(7, 5, 1, 1);
  mask(3, 2) = 0;
  const DisparityScores scores = score_disparity(estimate, truth, 1, mask);
  EXPECT_EQ(scores.scored, 13);
  EXPECT_EQ(scores.bad_pix_007, 0);
}

TEST(Metrics, NoEstimateAtAllHasNoMean) {
  const DisparityScores scores =
      score_disparity(FloatMap(3, 3, 1, kNaN), FloatMap(3, 3, 1, 0.0f), 0);
  EXPECT_EQ(scores.filled, 0);
  EXPECT_EQ(scores.bad_pix_007, 100);
  EXPECT_TRUE(std::isnan(scores.mse_x100));
  EXPECT_TRUE(std::isnan(scores.q25_x100));
}

TEST(Metrics, WhatCannotBeScoredIsAnError) {
  const FloatMap map(7, 5);
  EXPECT_THROW(score_disparity(FloatMap(5, 7), map, 0), Error);
  EXPECT_THROW(score_disparity(map, map, 0, Mask(5, 7)), Error);
  EXPECT_THROW(score_disparity(map, map, 3), Error) << "the border leaves no row";
  EXPECT_THROW(score_disparity(map, map, 0, Mask(7, 5)), Error) << "the mask leaves nothing";
  EXPECT_THROW(score_disparity(map, map, -1), Error);
  EXPECT_THROW(score_disparity(map, FloatMap(7, 5, 1, kNaN), 0), Error);
}

}  // namespace
}  // namespace gigaray
