// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gigaray/reconstruct.h"

namespace gigaray {
namespace {

TEST(Calibration, RisesFromLittleToCertainty) {
  EXPECT_FLOAT_EQ(calibrated_confidence(0), 0.2f);
  EXPECT_FLOAT_EQ(calibrated_confidence(-1), 0.2f);
  EXPECT_FLOAT_EQ(calibrated_confidence(1), 1);
  EXPECT_FLOAT_EQ(calibrated_confidence(7), 1);
  EXPECT_FLOAT_EQ(calibrated_confidence(0.3f), 0.9625f);
  EXPECT_TRUE(std::isnan(calibrated_confidence(kNoEstimate)));
  float last = 0;
  for (int i = 0; i <= 1000; ++i) {
    const float next = calibrated_confidence(float(i) / 1000);
    EXPECT_GT(next, last);
    last = next;
  }
}

TEST(Calibration, UnsureDisparitiesAreTakenBackAndTheirConfidenceStays) {
  ViewDepth depth{FloatMap(3, 1, 1, 0.5f), FloatMap(3, 1), Image<std::int8_t>(3, 1)};
  depth.confidence(0, 0) = 0.8f;
  depth.confidence(1, 0) = 0.9f;
  depth.confidence(2, 0) = kNoEstimate;
  drop_unsure(0.9f, depth);
  EXPECT_TRUE(std::isnan(depth.disparity(0, 0)));
  EXPECT_EQ(depth.disparity(1, 0), 0.5f);
  EXPECT_TRUE(std::isnan(depth.disparity(2, 0)));
  EXPECT_EQ(depth.confidence(0, 0), 0.8f);
}

}  // namespace
}  // namespace gigaray
