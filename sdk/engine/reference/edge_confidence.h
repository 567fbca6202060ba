// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// Edge confidence Ce (eq. 2) along u and, with both_axes, along v; the larger counts.
void edge_confidence(const Band& band, int ref, RowRange rows, const EdgeOptions& options,
                     bool both_axes, MapView<float> confidence);

}  // namespace gigaray::reference
