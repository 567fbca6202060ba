// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/depth_view.h"
#include "gigaray/core/image.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// Weights of the views that see a point (Buehler et al. 2001, unstructured lumigraph).
struct BlendOptions {
  /// false: all views that see a point count alike.
  bool view_dependent = true;
  int most_views = 4;        ///< Views that have a part in a pixel, the best ones. ≥ 1
  double resolution = 0.05;  ///< Penalty of a view that sees the point half as large, rad
  double field = 0.1;        ///< Penalty at the border of a view's field, rad,
  double border = 0.05;      ///< and the share of the picture's size where it begins.
};

struct NovelViewOptions {
  BlendOptions blend;
  /// Inverse depths that differ by no more are one surface, 1 / scene unit; 0: a hundredth of what
  /// the sources span.
  double tolerance = 0;
};

struct NovelView {
  Image<std::uint16_t> picture;  ///< RGB (v, u, c)
  FloatMap inverse_depth;        ///< (v, u), of this camera
  /// 1 where a source sees the point, 0 where the picture is filled in from beside (background) or
  /// black because there is nothing beside it.
  Mask seen;
};

/// The picture of a camera anywhere, from the coloured points of the sources (section 5.3): their
/// points are splatted into it in order of depth; of the surfaces that meet in a pixel the nearest
/// stays that more sources confirm than see through; there the colours of the sources that see it
/// are mixed, those that look from the same direction, as closely, and well inside their field
/// counting most. bit_depth: of all pictures. Throws Error(kInvalidArgument) without a source,
/// kCancelled.
NovelView render_view(const Camera& camera, std::span<const DepthView> sources, int bit_depth,
                      const NovelViewOptions& options, const RunControl& control);

/// Indices of the cameras that see what `camera` sees from nearest by, the best first: by distance,
/// and by the angle between the directions. exclude: index to leave out, −1: none.
std::vector<int> nearest_cameras(const std::vector<Camera>& cameras, const Camera& camera, int most,
                                 int exclude = -1);

/// Pose between two cameras: position and intrinsics linear, rotation along the shortest arc.
/// part: 0 … 1
Camera between(const Camera& a, const Camera& b, double part);

}  // namespace gigaray
