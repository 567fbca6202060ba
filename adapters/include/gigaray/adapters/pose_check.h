// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/adapters/pose_convention.h"
#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// How well poses fit what is seen in the pictures.
struct PoseAgreement {
  int num_pairs = 0;         ///< of pictures that have features in common; 0: nothing can be said
  double as_read = 0;        ///< share of features that fit the poses, 0 … 1, mean of the pairs
  PoseConvention best;       ///< under which most fit; of equals the one in use
  double share_of_best = 0;  ///< of it
};

/// Holds the cameras of an unstructured light field against features matched between some pictures
/// that follow each other: a feature fits where its two rays meet before both cameras. The same
/// matrices are read in every other convention too. Needs light_field.pose_reading.
PoseAgreement measure_pose_agreement(const LightField& light_field, const RunControl& control);

/// Does that for poses that wait for it, once. Throws Error(kBadInput) when they don't fit, naming
/// the convention that would. Where the user has stated the convention, and where it is not clear,
/// that is a message of `control`.
void check_poses(LightField& light_field, bool is_stated, const RunControl& control);

}  // namespace gigaray
