// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/interval_around.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gigaray {
namespace {

/// A ball (disparity 4 … 5) before a floor that comes from 0 to 10 from the top to the bottom.
FloatMap ball_before_floor() {
  FloatMap map(60, 50);
  for (int v = 0; v < 50; ++v)
    for (int u = 0; u < 60; ++u) {
      map(u, v) = float(10.0 * v / 49);
      const double r = std::hypot(u - 30, v - 10) / 8;
      if (r < 1) map(u, v) = float(4 + std::sqrt(1 - r * r));
    }
  return map;
}

TEST(IntervalAround, HoldsASurfaceUpToItsJumps) {
  const FloatMap map = ball_before_floor();
  const float jump = jump_of(map, 0.2f);
  const auto value = value_around(map, 30, 10, jump);
  ASSERT_TRUE(value);
  const ValueInterval found = interval_around(map, 30, 10, *value, jump);
  EXPECT_GT(found.least, 3.7f);
  EXPECT_LT(found.least, 4.7f);
  EXPECT_GT(found.most, 5.0f);
  EXPECT_LT(found.most, 5.4f);
}

TEST(IntervalAround, AFloorEndsAfterATenthOfTheRange) {
  const FloatMap map = ball_before_floor();
  const float jump = jump_of(map, 0.2f);
  const ValueInterval found = interval_around(map, 5, 40, map(5, 40), jump);
  EXPECT_NEAR(found.most - found.least, 2.2, 0.4);
}

TEST(IntervalAround, ValueIsThatOfTheOwnSide) {
  const FloatMap map = ball_before_floor();
  EXPECT_NEAR(*value_around(map, 30, 3, 0.4f), map(30, 3), 0.4);
}

TEST(IntervalAround, NoEstimateIsNoValue) {
  FloatMap map(3, 3, 1, kNoEstimate);
  EXPECT_FALSE(value_around(map, 1, 1, 1));
  EXPECT_EQ(jump_of(map, 0), 0);
  map(1, 1) = 2;
  EXPECT_EQ(*value_around(map, 1, 1, 0), 2);
  const ValueInterval found = interval_around(map, 1, 1, 2, 0);
  EXPECT_EQ(found.least, 2);
  EXPECT_EQ(found.most, 2);
}

}  // namespace
}  // namespace gigaray
