// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <limits>

#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

namespace gigaray {

/// How a view sees a point.
enum class Sight {
  kNothing,      ///< outside, hidden by something nearer, or no estimate there
  kSees,         ///< its surface is where the point is
  kSeesThrough,  ///< it sees something farther there
  kUnclear       ///< it sees something nearer and something farther beside each other
};

/// What a view says of a point.
struct Look {
  Sight sight = Sight::kNothing;
  /// Its inverse depth there over that of the point in its frame: interpolated where the four
  /// pixels show one surface, else of the one that comes nearest. NaN: not known.
  float ratio = std::numeric_limits<float>::quiet_NaN();
  float spread =
      0;  ///< How far the four pixels are apart, as a ratio to the point's inverse depth.
};

/// Looks at the four pixels around the point. Where they show one surface the point may lie
/// anywhere between their depths: surfaces are steep and pixels are wide. An inverse depth of 0 is
/// farther than everything.
Look look_at(const Camera& camera, const FloatMap& inverse_depth, const Eigen::Vector3d& point,
             float between_views, float between_pixels);

}  // namespace gigaray
