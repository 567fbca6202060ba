// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/camera.h"
#include "gigaray/image.h"

namespace gigaray {

/// How a view sees a point.
enum class Sight {
  kNothing,      ///< outside, hidden by something nearer, or no estimate there
  kSees,         ///< its surface is where the point is
  kSeesThrough,  ///< it sees something farther there
  kUnclear       ///< it sees something nearer and something farther beside each other
};

/// Looks at the four pixels around the point. Where they show one surface the point may lie
/// anywhere between their depths: surfaces are steep and pixels are wide.
Sight sight_of(const Camera& camera, const FloatMap& inverse_depth, const Eigen::Vector3d& point,
               float between_views, float between_pixels);

}  // namespace gigaray
