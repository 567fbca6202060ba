// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/engine/scene_estimates.h"
#include "picture_bands.h"

namespace gigaray {

/// The views that the search for the range looks at, the one in the middle first.
std::vector<int> central_views(const LightField& light_field);

/// As in scene_estimates.h, with small pictures that other trials of the same views share.
RangeEstimate estimate_disparity_range(const LightField& light_field, SmallViews& small,
                                       const RunControl& control);

/// The same of some views; the pixels of the first one are matched.
double measure_agreement(const LightField& light_field, const std::vector<int>& views,
                         SmallViews& small, const RunControl& control);

}  // namespace gigaray
