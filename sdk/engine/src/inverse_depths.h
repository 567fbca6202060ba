// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"

namespace gigaray {

/// Gives every camera of an unstructured light field its range of inverse depths: that of the
/// options, else its own, else one estimated from the pictures. Says what it found. Throws
/// Error(kBadInput) when nothing can be estimated, Error(kInvalidArgument) for a range with
/// negative inverse depths.
void set_inverse_depths(LightField& light_field, const DepthOptions& options,
                        const RunControl& control);

/// Says which views are compared with no other one and will have no depth. Throws Error(kBadInput)
/// when that holds for all that are wanted.
void check_partners(const LightField& light_field, const std::vector<int>& views,
                    const RunControl& control);

/// How far a point goes from the far to the near end of a view's range in the middle one of the
/// views that it is compared with, level-0 px; nine of ten views have no more.
double usual_travel(const LightField& light_field);

/// Hypotheses that every camera's range is sampled by, so that the step of the options is kept on
/// the usual travel, as far as the most that are reasonable go.
int count_hypotheses(double travel, const DepthOptions& options);

/// What differs between posed photographs and views on a line or in a grid, the kernels for presets
/// with ScoreOptions::gradient: they stand farther apart, so that each sees a smaller part of what
/// the others see, in another perspective. per_pixel: hypotheses for every px that a point goes.
void adapt_to_posed_views(double per_pixel, DepthOptions& options);

}  // namespace gigaray
