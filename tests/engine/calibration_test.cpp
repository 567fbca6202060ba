// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gigaray/engine/reconstruct.h"

namespace gigaray {
namespace {

TEST(Calibration, RisesFromLittleToCertainty) {
  const auto parallel = [](float contrast) {
    return calibrated_confidence(contrast, LightFieldKind::k3D);
  };
  const auto posed = [](float contrast) {
    return calibrated_confidence(contrast, LightFieldKind::kUnstructured);
  };
  EXPECT_FLOAT_EQ(parallel(0), 0.2f);
  EXPECT_FLOAT_EQ(parallel(-1), 0.2f);
  EXPECT_FLOAT_EQ(parallel(1), 1);
  EXPECT_FLOAT_EQ(parallel(7), 1);
  EXPECT_FLOAT_EQ(parallel(0.3f), 0.9625f);
  EXPECT_FLOAT_EQ(posed(0), 0.02f) << "a plateau of any height";
  EXPECT_FLOAT_EQ(posed(0.3f), 0.94f);
  EXPECT_FLOAT_EQ(posed(1), 1);
  for (const LightFieldKind kind : {LightFieldKind::k4D, LightFieldKind::kUnstructured}) {
    EXPECT_TRUE(std::isnan(calibrated_confidence(kNoEstimate, kind)));
    float last = 0;
    for (int i = 0; i <= 1000; ++i) {
      const float next = calibrated_confidence(float(i) / 1000, kind);
      EXPECT_GT(next, last);
      last = next;
    }
  }
}

TEST(Calibration, AgreementRisesFromNothingToCertainty) {
  EXPECT_FLOAT_EQ(calibrated_agreement(-1), 0.03f);
  EXPECT_FLOAT_EQ(calibrated_agreement(0.3f), 0.82f);
  EXPECT_FLOAT_EQ(calibrated_agreement(1), 0.998f);
  EXPECT_TRUE(std::isnan(calibrated_agreement(kNoEstimate)));
  float last = 0;
  for (int i = -64; i <= 100; ++i) {
    const float next = calibrated_agreement(0.01f * float(i));
    EXPECT_GT(next, last) << i;
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
