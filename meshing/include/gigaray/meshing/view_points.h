// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <span>

#include "gigaray/core/api.h"
#include "gigaray/core/point_cloud.h"
#include "gigaray/meshing/depth_view.h"

namespace GIGARAY_API gigaray {

/// Which pixels of a view become points.
struct PointOptions {
  double least_confidence = 0.1;  ///< Points that are less sure are left out. [0, 1]
  /// Other views that must see the point where it is; fewer where there are fewer views. ≥ 0.
  /// Empty: two, and kSupportShare of those that have its place in their pictures, know a depth
  /// there and have nothing before it.
  std::optional<int> least_support;
  /// Points of a white or black ground, if at least half of the border of every picture is that.
  bool keeps_plain_ground = false;
  int most_witnesses = 12;  ///< Other views that are asked, spread over all that look the same way.
};

/// Two of many agree by chance (docs/accuracy.md).
inline constexpr double kSupportShare = 0.8;

/// What became of pixels, in the order of the filters.
struct PointCounts {
  std::uint64_t pixels = 0;
  std::uint64_t without_estimate = 0;
  std::uint64_t ground = 0;        ///< of the plain ground around an object
  std::uint64_t unsure = 0;        ///< less confidence than asked for
  std::uint64_t too_far = 0;       ///< depth could as well be half or twice as large
  std::uint64_t contradicted = 0;  ///< more views see through the point than see it
  std::uint64_t unconfirmed = 0;   ///< fewer views see it than asked for
  std::uint64_t points = 0;        ///< what is left

  PointCounts& operator+=(const PointCounts& other);
};

/// Other views that can bear witness of what a view sees: those that look within 45° of it, the
/// nearest ones and, with even steps, farther ones.
std::vector<int> witnesses_of(const std::vector<Camera>& cameras, int view, int most);

/// 1 for the pixels of a view that become points, and how many witnesses see each there (v, u).
struct KeptPixels {
  Mask keep;
  FloatMap support;
  /// Of the view; where pixels are kept, what it and its witnesses agree on: the mean of what they
  /// have there, weighed by Tukey's biweight of the difference with twice the tolerance.
  FloatMap inverse_depth;
  PointCounts counts;
};

/// A witness sees a point when it has the point's depth there within the tolerance, which is a
/// pixel in the picture of the witness with the widest base at least. Throws
/// Error(kInvalidArgument) for options out of range.
KeptPixels keep_pixels(const DepthView& view, std::span<const DepthView> witnesses,
                       SurfaceTolerance tolerance, const PointOptions& options);

/// Unit normals of the pixels' surfaces towards the camera, (v, u, xyz), scene frame; from the
/// neighbours that belong to the same surface, else towards the camera. NaN: no estimate.
FloatMap normals_of(const DepthView& view, SurfaceTolerance tolerance);

/// Points of the pixels that are kept, row by row, in the frame of the view's camera, which floats
/// must be fine enough for (`nearby`). Normals as `normals_of` gives them.
PointCloud points_of(const DepthView& view, const KeptPixels& kept, SurfaceTolerance tolerance);

}  // namespace gigaray
