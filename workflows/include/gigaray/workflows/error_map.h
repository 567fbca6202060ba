// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// The signed error as an 8-bit RGB picture (v, u, c): white is right, red too far by `range` or
/// more, blue too near, as the HCI benchmark draws it. Black: no estimate. Grey: not scored (truth
/// unknown, or in the border of so many px). The maps have one size; range > 0.
Image<std::uint16_t> draw_error_map(const FloatMap& estimate, const FloatMap& truth, int border,
                                    double range);

}  // namespace gigaray
