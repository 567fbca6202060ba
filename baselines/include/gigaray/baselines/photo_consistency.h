// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"

namespace gigaray::baselines {

/// How well a disparity map, px per view step, explains the other views, without any truth: per
/// pixel the median over the views of the difference of colours (mean of the channels, of 255)
/// between the pixel and where the view should show it; the mean of that over all pixels with an
/// estimate that another view can show, NaN when there is none. Half of the views may be occluded.
/// At most `most_views` views, evenly chosen.
double photo_consistency(const LightField& light_field, int view, const FloatMap& disparity,
                         int most_views = 16);

}  // namespace gigaray::baselines
