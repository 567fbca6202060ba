// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/depth.h"

namespace gigaray {

/// The range of disparities (of photographs with cameras inverse depths) of what is between two
/// distances. Throws Error(kInvalidArgument) for distances that can't be meant and where no rig is
/// known.
DisparityRange range_of(const DistanceRange& distances, const LightField& light_field);

/// Of photographs with cameras a range of distances is stated easily where one of inverse depths is
/// meant. Holds it against what the cameras see, where the input says so: throws
/// Error(kInvalidArgument) when all of it lies nearer and it fits as distances, and notes what may
/// be a mistake.
void check_inverse_depth(const DisparityRange& stated, const LightField& light_field,
                         const RunControl& control);

}  // namespace gigaray
