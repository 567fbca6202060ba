// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// Gives the cameras of an unstructured light field that have no range of inverse depths that of
/// features (SIFT): matched along epipolar lines between views that look a similar way,
/// triangulated, and seen in a third view where there is one. A view with too few of them takes
/// those that its neighbours found and it sees, one without any the range of all views. Says so
/// through control.message. Changes nothing when fewer than half of the views get points: the
/// engine estimates ranges by a search then.
///
/// Memory: 2 MB per view, of 60 views at most, and one picture at a time. Throws what reading
/// pictures throws, Error(kCancelled).
void take_range_of_features(LightField& light_field, const RunControl& control);

}  // namespace gigaray
