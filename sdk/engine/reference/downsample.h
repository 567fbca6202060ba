// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// 7×7 Gaussian of σ = √0.5, then every second pixel. small: [small_rows][view][3][(width + 1) /
/// 2].
void downsample(const Band& band, RowRange small_rows, float* small);

}  // namespace gigaray::reference
