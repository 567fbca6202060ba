// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>

#include "gigaray/applications/segmentation.h"
#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// The value of the map at a pixel, steadied: the median of those in 3 × 3 pixels that lie on the
/// same surface, that is, within `jump` of it. Empty: there is no estimate. The pixel must be in
/// the map.
std::optional<float> value_around(const FloatMap& map, int u, int v, float jump);

/// The difference of neighbouring pixels above which a surface ends: two steps between hypotheses,
/// or 1.5 % of the range of the map (1 … 99 %) if that is more. step: 0 if it is not known. 0 for a
/// map without two different values.
float jump_of(const FloatMap& map, float step);

/// The surface that a pixel lies on: from it on over neighbours without a jump, but no farther than
/// a tenth of the range of the map from its value, so that a floor does not bring the whole scene.
/// The interval holds 98 % of that surface and half a jump more on both sides. value: that of the
/// pixel, see value_around().
ValueInterval interval_around(const FloatMap& map, int u, int v, float value, float jump);

}  // namespace gigaray
