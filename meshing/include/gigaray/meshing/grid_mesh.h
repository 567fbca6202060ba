// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/surface_mesh.h"
#include "gigaray/meshing/view_points.h"

namespace GIGARAY_API gigaray {

/// The paper's surface (its figure 7): depth maps are triangulated on the pixel grid, cut where
/// depth jumps, and what one view shows is left out of the next. Begins with the view in the
/// middle, then takes the view that is farthest from those before. counts: what became of the
/// pixels, may be null. Normals are those of the depth maps. Throws Error(kInvalidArgument) for
/// options, Error(kBadInput) when no triangle is left, kCancelled, and what `views` throws.
SurfaceMesh grid_mesh(const DepthViews& views, const PointOptions& options, PointCounts* counts,
                      const RunControl& control);

/// Indices of views: the one nearest to the middle, then always the one farthest from those before.
std::vector<int> farthest_first(const std::vector<Camera>& cameras);

}  // namespace gigaray
