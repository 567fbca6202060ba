// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

// Segmentation by depth (section 5.3): what lies in an interval.

/// Closed interval of the values of a map: disparity, inverse depth or depth.
struct ValueInterval {
  float least = 0, most = 0;
};

/// 1 where the value lies in the interval, 0 elsewhere and where there is no estimate (NaN). Quick
/// enough for a slider: it runs at the speed of memory, on all cores. mask: the size of the map, or
/// another and then made anew.
void segment(const FloatMap& map, ValueInterval interval, Mask& mask);

struct MatteOptions {
  int radius = 4;          ///< Half the width of the soft edge, px. 1 … 64
  float contrast = 0.05f;  ///< Colour differences below it are the same material, [0, 1]. > 0
};

/// The mask with soft edges: within `radius` of its edge, opacity is where the pixel's colour lies
/// between the mean colours outside and inside, as far as these differ by more than their spread
/// and `contrast`, and the mask with an edge of about a pixel where they don't; 0 or 1 elsewhere.
/// picture: RGB (v, u, c), 0 … 2^bit_depth − 1, the size of the mask. Result: (v, u) in [0, 1].
/// Throws Error(kInvalidArgument) for options out of range.
FloatMap soft_matte(const Mask& mask, const Image<std::uint16_t>& picture, int bit_depth,
                    const MatteOptions& options);

}  // namespace gigaray
