// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/errors.h"

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

TEST(Middlebury, GoldenScoresOfElevenErrors) {
  // Errors 0, 0.5, 1 ... 5 in steps of 0.5, of both signs.
  FloatMap estimate(11, 1), truth(11, 1, 1, 10.0f);
  for (int u = 0; u < 11; ++u) estimate(u, 0) = 10 + (u % 2 ? 0.5f : -0.5f) * float(u);
  const MiddleburyScores scores = score_middlebury(estimate, truth);
  EXPECT_EQ(scores.scored, 11);
  EXPECT_DOUBLE_EQ(scores.bad_05, 100 * 9 / 11.0) << "an error of exactly 0.5 is not bad";
  EXPECT_DOUBLE_EQ(scores.bad_10, 100 * 8 / 11.0);
  EXPECT_DOUBLE_EQ(scores.bad_20, 100 * 6 / 11.0);
  EXPECT_DOUBLE_EQ(scores.bad_40, 100 * 2 / 11.0);
  EXPECT_DOUBLE_EQ(scores.average_error, 2.5);
  EXPECT_DOUBLE_EQ(scores.rms, std::sqrt(385 * 0.25 / 11));
  EXPECT_DOUBLE_EQ(scores.a50, 2.5);
  EXPECT_DOUBLE_EQ(scores.a90, 4.5);
  EXPECT_DOUBLE_EQ(scores.a95, 4.75);
  EXPECT_NEAR(scores.a99, 4.95, 1e-12);
  EXPECT_EQ(scores.filled, 100);
}

TEST(Middlebury, UnknownTruthIsNotScoredAndMissingEstimatesAreBad) {
  const FloatMap estimate = row_of({1, kNaN, 3, 9, kInfinity});
  const FloatMap truth = row_of({1, 2, kInfinity, kNaN, 1});
  const MiddleburyScores scores = score_middlebury(estimate, truth);
  EXPECT_EQ(scores.scored, 3);
  EXPECT_DOUBLE_EQ(scores.filled, 100 / 3.0);
  EXPECT_DOUBLE_EQ(scores.bad_40, 200 / 3.0);
  EXPECT_EQ(scores.average_error, 0);
  EXPECT_EQ(scores.a99, 0);
}

TEST(Middlebury, OnlyTheMaskIsScored) {
  Mask mask(3, 1);
  mask(1, 0) = 1;
  const MiddleburyScores scores =
      score_middlebury(row_of({9, 3, 9}), FloatMap(3, 1, 1, 0.0f), 0, mask);
  EXPECT_EQ(scores.scored, 1);
  EXPECT_EQ(scores.bad_20, 100);
  EXPECT_EQ(scores.bad_40, 0);
  EXPECT_EQ(scores.rms, 3);
}

TEST(Middlebury, NoEstimateAtAllHasNoMean) {
  const MiddleburyScores scores =
      score_middlebury(FloatMap(3, 3, 1, kNaN), FloatMap(3, 3, 1, 0.0f));
  EXPECT_EQ(scores.bad_05, 100);
  EXPECT_TRUE(std::isnan(scores.average_error) && std::isnan(scores.rms) &&
              std::isnan(scores.a50) && std::isnan(scores.a99));
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

TEST(DepthMetrics, SharesAreOfTheRelativeErrorAndOfAllOrOfTheFilled) {
  // Errors of 0.4, 0.9, 1.9, 4.9 and 9 %, one pixel without an estimate; of depths that differ.
  const FloatMap truth = row_of({1, 2, 4, 8, 16, 32});
  const FloatMap estimate = row_of({1.004f, 2 * 0.991f, 4 * 1.019f, 8 * 0.951f, 16 * 1.09f, kNaN});
  DepthErrors errors;
  errors.add(estimate, truth);
  const DepthScores scores = errors.scores();
  EXPECT_EQ(scores.scored, 6);
  EXPECT_DOUBLE_EQ(scores.filled, 500 / 6.0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(scores.within[i], 100 * (i + 1) / 6.0);
    EXPECT_DOUBLE_EQ(scores.within_filled[i], 20 * (i + 1));
  }
  EXPECT_NEAR(scores.median, 1.9, 1e-4);
}

TEST(DepthMetrics, UnknownTruthIsNotScoredAndNoDepthIsNoEstimate) {
  DepthErrors errors;
  errors.add(row_of({1, 1, 1, 1, 0, -1, kInfinity}), row_of({0, kNaN, kInfinity, -2, 1, 1, 1}));
  EXPECT_EQ(errors.scores().scored, 3);
  EXPECT_EQ(errors.scores().filled, 0);
  EXPECT_EQ(errors.scores().within[3], 0);
  EXPECT_TRUE(std::isnan(errors.scores().within_filled[3]));
  EXPECT_TRUE(std::isnan(errors.scores().median));
  EXPECT_TRUE(std::isnan(DepthErrors().scores().within[0]));
}

TEST(DepthMetrics, TheMostConfidentAreCountedOfThoseKeptAndOfAll) {
  const FloatMap truth(8, 1, 1, 2.0f);
  // The surer half is exact, but for one pixel.
  const FloatMap estimate = row_of({2, 2, 3, 2, 3, 3, 3, kNaN});
  const FloatMap confidence = row_of({0.9f, 0.8f, 0.7f, 0.6f, 0.5f, 0.4f, kNaN, 1});
  DepthErrors errors;
  errors.add(estimate, truth, confidence);
  const DepthScores half = errors.most_confident(50);
  EXPECT_DOUBLE_EQ(half.filled, 50);
  EXPECT_DOUBLE_EQ(half.within_filled[0], 75);
  EXPECT_DOUBLE_EQ(half.within[0], 37.5);
  EXPECT_DOUBLE_EQ(half.median, 0);
  EXPECT_DOUBLE_EQ(errors.most_confident(25).within_filled[1], 100);
  // Fewer estimates than asked for: all of them.
  EXPECT_DOUBLE_EQ(errors.most_confident(100).filled, 700 / 8.0);
  EXPECT_DOUBLE_EQ(errors.most_confident(100).within_filled[0], 300 / 7.0);
  EXPECT_EQ(errors.most_confident(0).filled, 0);
  testing_support::expect_error(ErrorCode::kInvalidArgument, {"101"},
                                [&] { errors.most_confident(101); });
}

TEST(DepthMetrics, EquallySurePixelsAreNotTakenFromOneEndOfThePicture) {
  const int width = 100;
  FloatMap estimate(width, width, 1, 1.0f);
  for (int v = 0; v < width / 2; ++v)
    for (int u = 0; u < width; ++u) estimate(u, v) = 2;
  const FloatMap flat(width, width, 1, 1.0f);
  DepthErrors errors;
  errors.add(estimate, flat, flat);
  EXPECT_NEAR(errors.most_confident(50).within_filled[0], 50, 2);
}

TEST(DepthMetrics, ViewsAreCountedTogetherAndOneWithoutConfidenceTakesItFromAll) {
  DepthErrors errors;
  errors.add(row_of({1, 1}), row_of({1, 1}), row_of({1, 1}));
  EXPECT_EQ(errors.most_confident(50).within_filled[0], 100);
  errors.add(row_of({2, 2}), row_of({1, 1}));
  EXPECT_EQ(errors.scores().scored, 4);
  EXPECT_EQ(errors.scores().within[3], 50);
  EXPECT_TRUE(std::isnan(errors.most_confident(50).within_filled[0]));
  EXPECT_TRUE(std::isnan(errors.most_confident(50).filled));
}

TEST(DepthMetrics, BorderAndSizesAreChecked) {
  DepthErrors errors;
  FloatMap estimate(5, 3, 1, 1.0f);
  estimate(0, 0) = 9;
  errors.add(estimate, FloatMap(5, 3, 1, 1.0f), {}, 1);
  EXPECT_EQ(errors.scores().scored, 3);
  EXPECT_EQ(errors.scores().within[0], 100);
  testing_support::expect_error(ErrorCode::kBadInput, {"5 x 3", "4 x 3"},
                                [&] { errors.add(estimate, FloatMap(4, 3)); });
  testing_support::expect_error(ErrorCode::kBadInput, {"4 x 3"},
                                [&] { errors.add(estimate, estimate, FloatMap(4, 3)); });
}

}  // namespace
}  // namespace gigaray
