// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration.h"

#include <array>
#include <cmath>

namespace gigaray {
namespace {

struct Point {
  float contrast, right;
};

/// Middles of the bins of contrast and the mean share of right pixels over 14 scenes and variants.
constexpr std::array<Point, 11> kPoints{{{0.0f, 0.2f},
                                         {0.01f, 0.4f},
                                         {0.035f, 0.6f},
                                         {0.075f, 0.72f},
                                         {0.125f, 0.85f},
                                         {0.175f, 0.91f},
                                         {0.25f, 0.95f},
                                         {0.35f, 0.975f},
                                         {0.45f, 0.985f},
                                         {0.55f, 0.997f},
                                         {1.0f, 1.0f}}};

}  // namespace

float calibrated_confidence(float contrast) {
  if (std::isnan(contrast)) return contrast;
  if (contrast <= kPoints.front().contrast) return kPoints.front().right;
  for (std::size_t i = 1; i < kPoints.size(); ++i) {
    const Point &low = kPoints[i - 1], &high = kPoints[i];
    if (contrast <= high.contrast)
      return low.right +
             (high.right - low.right) * (contrast - low.contrast) / (high.contrast - low.contrast);
  }
  return kPoints.back().right;
}

}  // namespace gigaray
