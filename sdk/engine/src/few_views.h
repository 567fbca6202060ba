// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/engine/scene_estimates.h"

namespace gigaray {

/// How many others a view is compared with at most.
int most_others(const LightField& light_field);

/// What follows from the number of views alone: with three others or fewer, jumps cost more, and
/// with one what is hidden is filled.
void adapt_to_few_views(const LightField& light_field, DepthOptions& options);

/// Noise of few views, of windows. The least of many distances of one pixel is one by chance: of
/// two pictures of a wide range estimate_noise() finds a half or a third of the noise there is.
/// Which hypothesis is right is asked the pixels around, too, and how far the pixel is off says it
/// alone. lead: 0. view: whose. Memory: some rows of all views.
NoiseEstimate estimate_window_noise(const LightField& light_field, int view,
                                    const HypothesisRange& hypotheses, const RunControl& control);

/// Widens the bandwidths and sigma_colour to what this noise asks for.
void widen(const NoiseEstimate& noise, DepthOptions& options);

}  // namespace gigaray
