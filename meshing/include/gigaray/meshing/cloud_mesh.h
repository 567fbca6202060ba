// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/point_cloud.h"
#include "gigaray/core/run_control.h"
#include "gigaray/core/surface_mesh.h"

namespace GIGARAY_API gigaray {

// Surfaces through points (CGAL). Colours are those of the nearest points. Distances are measured
// in the usual distance of a point from its neighbours, there, so that far and near parts of a
// scene are treated alike. Both throw Error(kInvalidArgument) for options, Error(kBadInput) when
// the points are too few or give no surface, and kCancelled.

struct PoissonOptions {
  double spacing = 1;  ///< Size of the triangles. > 0
  /// Vertices are cut away that are farther from the next point; 0: none, the surface is closed.
  double trim = 2;
};

/// Smooth, closes what is not seen (Kazhdan et al. 2006; trimmed). Needs normals. The same points
/// give the same surface.
SurfaceMesh poisson_mesh(const PointCloud& cloud, const PoissonOptions& options,
                         const RunControl& control);

struct AdvancingFrontOptions {
  /// No triangle has an edge longer than this.
  double longest_edge = 3;
};

/// Triangles between the points themselves (Cohen-Steiner and Da 2004): keeps what is sharp and
/// thin, interpolates noise too.
SurfaceMesh advancing_front_mesh(const PointCloud& cloud, const AdvancingFrontOptions& options,
                                 const RunControl& control);

}  // namespace gigaray
