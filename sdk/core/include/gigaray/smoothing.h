// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>

#include "gigaray/light_field.h"

namespace gigaray {

/// A picture (v, u, c) under a Gaussian of `sigma` px, edges repeated, rounded to integers.
Image<std::uint16_t> smooth_picture(const Image<std::uint16_t>& picture, double sigma);

/// The same light field with every view smoothed as it is read. sigma: px, > 0.
LightField smoothed(LightField light_field, double sigma);

}  // namespace gigaray
