// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/metric_depth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gigaray {
namespace {

FloatMap row(std::initializer_list<float> values) {
  FloatMap map(int(values.size()), 1);
  std::copy(values.begin(), values.end(), map.begin());
  return map;
}

TEST(MetricDepth, DisparityZeroIsAtTheFocusDistance) {
  const RigGeometry rig{1000, 0.025, 5, "m"};
  const FloatMap depth = depth_from_disparity(row({0, 5, -2.5f}), rig);
  EXPECT_FLOAT_EQ(depth(0, 0), 5);
  EXPECT_FLOAT_EQ(depth(1, 0), 2.5f);
  EXPECT_FLOAT_EQ(depth(2, 0), 10);
}

TEST(MetricDepth, WithoutFocusDisparityZeroIsAtInfinity) {
  const RigGeometry rig{800, 30, std::nullopt, "mm"};
  const FloatMap depth = depth_from_disparity(row({2, 0, -1}), rig);
  EXPECT_FLOAT_EQ(depth(0, 0), 12000);
  EXPECT_TRUE(std::isnan(depth(1, 0)));
  EXPECT_TRUE(std::isnan(depth(2, 0)));
}

TEST(MetricDepth, NoEstimateStaysNone) {
  const RigGeometry rig{1000, 0.025, 5, "m"};
  const FloatMap depth = depth_from_disparity(row({kNoEstimate, -5, -7}), rig);
  for (const float z : depth) EXPECT_TRUE(std::isnan(z));
}

TEST(MetricDepth, NeedsFocalLengthAndBaseline) {
  EXPECT_TRUE(has_metric_depth({1000, 0.025, std::nullopt, ""}));
  EXPECT_FALSE(has_metric_depth({1000, std::nullopt, 5, ""}));
  EXPECT_FALSE(has_metric_depth({std::nullopt, 0.025, 5, ""}));
}

}  // namespace
}  // namespace gigaray
