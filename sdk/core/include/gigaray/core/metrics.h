// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

// Scores of a whole disparity map; gigaray/core/region_metrics.h has those of parts of a scene.
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

/// Scores of depth, of errors relative to the true one: |estimate / truth - 1|.
struct DepthScores {
  static constexpr std::array<double, 4> kWithinPercent{0.5, 1, 2, 5};
  std::array<double, 4> within{};         ///< Percentage of scored pixels within each of those
  std::array<double, 4> within_filled{};  ///< The same of the pixels with an estimate; NaN: none
  double median = 0;  ///< Of the error, percent, of pixels with an estimate; NaN: none
  double filled = 0;  ///< Percentage of scored pixels that have an estimate.
  long scored = 0;    ///< Number of scored pixels; 0: all shares are NaN.
};

/// Relative errors of depth maps, of one view or of several together; 8 bytes per estimate.
class DepthErrors {
 public:
  /// Adds a view. Scored are pixels whose true depth is finite and above 0, an estimate counts when
  /// it is too. confidence: finite or NaN, any scale; empty: not known. Throws Error(kBadInput)
  /// when sizes differ, Error(kInvalidArgument) for a negative border.
  void add(const FloatMap& estimate, const FloatMap& truth, const FloatMap& confidence = {},
           int border = 0);

  DepthScores scores() const;
  /// As if only the most confident pixels had estimates: so many percent (0 … 100) of those scored,
  /// or all estimates where there are fewer. Which of several equally sure ones stay is chance, and
  /// always the same. NaN when a view came without confidence.
  DepthScores most_confident(double percent) const;

 private:
  struct Pixel {
    float error;
    float confidence;
  };
  DepthScores scores_of(const std::vector<Pixel>& filled) const;

  std::vector<Pixel> filled_;
  long scored_ = 0;
  bool has_confidence_ = true;
};

}  // namespace gigaray
