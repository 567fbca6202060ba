// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/calibration/rail.h"
#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// A rail known by nothing but the order of its views: they stand at equal steps of 1 along a line
/// that the movement of the tracks tells, and look the same way. The scene frame is that of the
/// cameras, the origin is the middle of the rail. A start for adjust_rail. Throws Error(kBadInput)
/// for fewer than 3 views, and when the tracks don't show one direction of travel.
Rail known_order_start(int num_views, const RadialLens& lens, const std::vector<Track>& tracks);

}  // namespace gigaray
