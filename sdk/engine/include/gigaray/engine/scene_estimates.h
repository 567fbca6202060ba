// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"

namespace GIGARAY_API gigaray {

/// What the pictures themselves say about the range of disparities.
struct RangeEstimate {
  DisparityRange range;       ///< Robust percentiles of reliable pixels, widened.
  double negative_share = 0;  ///< Share of reliable pixels with a disparity below zero.
  long samples = 0;           ///< Reliable pixels.
  double agreement = 0;       ///< Mean score of all pixels at their best hypothesis, 0 … 1.
  /// A reliable pixel of the centre view: level-0 px, of the first of pixel_size px per axis.
  struct Match {
    int u = 0;
    int v = 0;
    float disparity = 0;
  };
  std::vector<Match> matches;
  int pixel_size = 1;  ///< Level-0 px per pixel of the small pictures.
  double radius = 0;   ///< View steps from the centre to the farthest view that was looked at.
};

/// Finds the range by a coarse search on a small version of the pictures around the centre view.
/// Throws Error(kBadInput) when nothing can be matched; --disparity is the way out then.
RangeEstimate estimate_disparity_range(const LightField& light_field, const RunControl& control);

/// Mean score of the strongest edges of the first view of a line or grid at their best hypothesis,
/// 0 … 1; 0 without edges. For trials: a fifth of the pixels of estimate_disparity_range.
double measure_agreement(const LightField& light_field, const RunControl& control);

/// Gives the cameras of an unstructured light field that have none a range of inverse depths. A
/// first bound comes from the cameras: what is seen by two of them at least. Within it the
/// strongest edges of some views are matched, and every camera gets the range of the points that it
/// sees. Without reading pixels the bound has to do. Throws Error(kBadInput) when cameras share no
/// view or nothing matches; --disparity is the way out then.
void estimate_inverse_depths(LightField& light_field, const RunControl& control, bool read_pixels);

/// Noise of a light field, from how well views agree at their best hypothesis.
struct NoiseEstimate {
  double colour = 0;    ///< 25th percentile of the least mean colour distance, encoded RGB
  double gradient = 0;  ///< The same of the gradients
  /// By how much the mean colour distance over all hypotheses exceeds the least one, relative to
  /// it: median over the pixels.
  double lead = 0;
  int view = 0;  ///< where it was measured
};

/// Measures on an 8 px grid of some rows: of the centre view of a line or grid, where it agrees
/// with others; else, and of posed views, of up to five that are compared with others, the one in
/// the middle of those that agree with them. Partners that show something else than the rest don't
/// count. Where no view agrees, there is no noise to see: a message says so. Memory: those rows of
/// all views; of posed ones 9 whole views at most.
NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control);

/// NoiseEstimate::lead of pictures (docs/accuracy.md): above the first, a single ray tells enough
/// and smoothing would only cost; above the second the pixel's own value is better than a mean
/// along its ray. Clean pictures have 2.6 and more, cleaned JPEG of quality 90 and 75 has 1.5 to
/// 2.3, noise of 2 % of the range 0.3 to 0.7 where the texture is weak.
inline constexpr double kLeadWithoutSmoothing = 1.0, kLeadOfOwnPixel = 2.5;
/// NoiseEstimate::colour of pictures without noise is below; a small lead is then for want of
/// texture. Clean renderings of 8 bit have 0.003.
inline constexpr double kLeastNoise = 0.001;

/// Sets the bandwidths and sigma_colour of options from the noise (ACCURACY: the measured rule).
void apply_noise(const NoiseEstimate& noise, DepthOptions& options);

/// How much rays alone leave open, 0 … 1: in noisy pictures of weak texture, and where a view is
/// compared with few others. noise: of the pictures as they are compared; lead: before they were
/// smoothed. others: ≥ 1.
double ray_doubt(const NoiseEstimate& noise, double lead, int others);

/// Gives neighbours and gradients more weight, from the usual to that in doubt. doubt: 0 … 1.
void apply_doubt(double doubt, DepthOptions& options);

}  // namespace gigaray
