// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// Median of the estimates of similar colour in a window (eq. 8); of an even number the lower
/// middle.
void bilateral_median(const Band& band, int ref, RowRange rows, int radius, float tolerance,
                      MapView<const float> in, MapView<float> out);

}  // namespace gigaray::reference
