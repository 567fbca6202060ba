// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// A picture (v, u, c) under a Gaussian of `sigma` px, edges repeated, rounded to integers.
Image<std::uint16_t> smooth_picture(const Image<std::uint16_t>& picture, double sigma);

/// The same light field with every view smoothed as it is read. sigma: px, > 0.
LightField smoothed(LightField light_field, double sigma);

/// A light field of posed cameras at half the size, rounded up: every second pixel of views that
/// are smoothed as pyramid levels are (σ = √0.5 px). The pictures beneath are not let go. Throws
/// Error(kInvalidArgument) for other kinds.
LightField halved(LightField light_field);

}  // namespace gigaray
