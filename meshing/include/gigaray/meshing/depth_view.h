// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/depth_view.h"
#include "gigaray/core/image.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// Views in a frame that floats are fine enough for.
struct NearbyViews {
  DepthViews views;                                  ///< the scene's axes, relative to `origin`
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< see PointCloud::origin
};

/// The views themselves while a float at the place of every camera is finer than 1/256 of
/// `spacing`; else relative to a round place in their middle. spacing: distance of neighbouring
/// points, scene units. Example: cameras around (500123.25, 4649776.5, 210) with points 0.02 apart:
/// the origin is (500100, 4649800, 200).
NearbyViews nearby(const DepthViews& views, double spacing);

/// How far inverse depths may be apart and still belong to one surface, 1 / scene unit.
struct SurfaceTolerance {
  /// Between views at most, and what depth may be off: a hundredth of the range that is seen.
  float between_views = 0;
  /// Between views, share of the inverse depth; > 0.
  float between_views_relative = 0.01f;
  /// Between neighbouring pixels at least; a slope of up to 80° is allowed too.
  float between_pixels = 0;

  /// range: of the inverse depths of all views.
  static SurfaceTolerance of(InverseDepthRange range);
  /// Between views at an inverse depth. finest: what views can tell apart, 1 / scene unit; no less
  /// is asked for.
  float at(float inverse_depth, float finest) const;
};

/// What all views see on the whole, from a sample of their pixels.
struct Survey {
  InverseDepthRange range;  ///< of the inverse depths, without the outermost 0.1 % on both sides
  /// Distance of neighbouring pixels' points that a quarter of all pixels stay below, scene units.
  double spacing = 0;
};

/// Throws Error(kBadInput) when no view has an estimate.
Survey survey(const DepthViews& views, const RunControl& control);

/// Do two neighbouring pixels of a view show one surface?
bool is_one_surface(float inverse_depth, float other, double focal_px, float between_pixels);

}  // namespace gigaray
