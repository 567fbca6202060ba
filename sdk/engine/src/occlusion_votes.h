// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/scene_estimates.h"

namespace gigaray {

/// Places in other views where two points of the centre view fall on one pixel, by which of the two
/// is seen there. When the sign of the disparities is right, the nearer one hides the farther.
struct OcclusionVotes {
  int nearer = 0;
  int farther = 0;
  int count() const { return nearer + farther; }
};

/// Looks at the reliable matches of an estimate for this very light field. Memory: a few views.
OcclusionVotes count_occlusions(const LightField& light_field, const RangeEstimate& estimate,
                                const RunControl& control);

}  // namespace gigaray
