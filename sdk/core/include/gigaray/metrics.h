// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/image.h"

namespace gigaray {

// Scores of a whole disparity map; gigaray/region_metrics.h has those of parts of a scene.
// For all of them: pixels whose truth is not finite are ignored; pixels whose estimate is not
// finite count as bad and are left out of means and quantiles. border: px ignored on each side.
// mask: pixels to score, non-zero; empty scores all. They throw Error(kBadInput) when sizes differ
// or nothing is left to score.

/// The general metrics of the HCI 4D light field benchmark (Honauer et al. 2016).
struct DisparityScores {
  double bad_pix_007 = 0;  ///< Percentage of scored pixels with |error| > 0.07
  double bad_pix_003 = 0;
  double bad_pix_001 = 0;
  double mse_x100 = 0;  ///< Mean squared error times 100; NaN if nothing is filled.
  double q25_x100 = 0;  ///< 25th percentile of |error| times 100 (linear interpolation).
  double filled = 0;    ///< Percentage of scored pixels that have an estimate.
  long scored = 0;      ///< Number of scored pixels.
};

/// The benchmark leaves a border of 15 px out.
DisparityScores score_disparity(const FloatMap& estimate, const FloatMap& truth, int border = 15,
                                const Mask& mask = {});

/// The metrics of the Middlebury stereo benchmark, version 3 (Scharstein et al. 2014), in px of
/// disparity.
struct MiddleburyScores {
  double bad_05 = 0;  ///< Percentage of scored pixels with |error| > 0.5
  double bad_10 = 0;
  double bad_20 = 0;
  double bad_40 = 0;
  double average_error = 0;  ///< Mean |error|; NaN if nothing is filled, as all below.
  double rms = 0;            ///< Root of the mean squared error
  double a50 = 0;            ///< Median of |error| (quantiles: linear interpolation)
  double a90 = 0;
  double a95 = 0;
  double a99 = 0;
  double filled = 0;  ///< Percentage of scored pixels that have an estimate.
  long scored = 0;    ///< Number of scored pixels.
};

MiddleburyScores score_middlebury(const FloatMap& estimate, const FloatMap& truth, int border = 0,
                                  const Mask& mask = {});

}  // namespace gigaray
