// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>

#include "gigaray/image.h"

namespace gigaray {

/// The general metrics of the HCI 4D light field benchmark (Honauer et al. 2016).
/// Pixels whose truth is not finite are ignored; pixels whose estimate is not finite count as bad
/// and are left out of MSE and Q25.
struct DisparityScores {
  double bad_pix_007 = 0;  ///< Percentage of scored pixels with |error| > 0.07
  double bad_pix_003 = 0;
  double bad_pix_001 = 0;
  double mse_x100 = 0;  ///< Mean squared error times 100; NaN if nothing is filled.
  double q25_x100 = 0;  ///< 25th percentile of |error| times 100 (linear interpolation).
  double filled = 0;    ///< Percentage of scored pixels that have an estimate.
  long scored = 0;      ///< Number of scored pixels.
};

/// border: px ignored on each side (the benchmark: 15). mask: pixels to score, non-zero; empty
/// scores all. Throws Error(kBadInput) when sizes differ or nothing is left to score.
DisparityScores score_disparity(const FloatMap& estimate, const FloatMap& truth, int border = 15,
                                const Mask& mask = {});

}  // namespace gigaray
