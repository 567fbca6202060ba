// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>

#include "gigaray/depth_options.h"
#include "gigaray/light_field.h"
#include "gigaray/ray_sampler.h"
#include "gigaray/run_control.h"

namespace gigaray {

/// What the pictures themselves say about the range of disparities.
struct RangeEstimate {
  DisparityRange range;       ///< Robust percentiles of reliable pixels, widened.
  double negative_share = 0;  ///< Share of reliable pixels with a disparity below zero.
  long samples = 0;           ///< Reliable pixels.
  double agreement = 0;       ///< Mean score of all pixels at their best hypothesis, 0 … 1.
};

/// Finds the range by a coarse search on a small version of the pictures around the centre view.
/// Throws Error(kBadInput) when nothing can be matched; --disparity is the way out then.
RangeEstimate estimate_disparity_range(const LightField& light_field, const RunControl& control);

/// When the adapter only assumed the signs of the axes, checks them against the pictures and corrects
/// them, saying so through control.message. 4D: of (s, t) and (s, −t) the one under which views agree
/// better. Then, when nearly all disparities are negative, which parallel cameras can't see, both axes
/// are turned around. Returns the range that it had to estimate for that, if any.
std::optional<DisparityRange> check_direction(LightField& light_field, const RunControl& control);

/// Noise of a light field, from how well views agree at their best hypothesis.
struct NoiseEstimate {
  double colour = 0;    ///< 25th percentile of the least mean colour distance, encoded RGB
  double gradient = 0;  ///< The same of the gradients
};

/// Measures on an 8 px grid of some rows of the centre view. Memory: those rows of all views.
NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control);

/// Sets the bandwidths and sigma_colour of options from the noise (ACCURACY: the measured rule).
void apply_noise(const NoiseEstimate& noise, DepthOptions& options);

}  // namespace gigaray
