// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <functional>

#include "gigaray/core/point_cloud.h"
#include "gigaray/core/surface_mesh.h"
#include "neighbours.h"

namespace gigaray {

// What surfaces through points have in common.

/// Throws Error(kBadInput) for a cloud that no surface can be put through.
void check_cloud(const PointCloud& cloud);

/// The mean colour of the nearest points, weighted by nearness.
Rgb8 colour_at(const Eigen::Vector3f& place, const PointCloud& cloud, const Neighbours& neighbours);

/// Turns pieces over whose triangles look away from where their points were seen from.
void turn_to_normals(SurfaceMesh& mesh, const PointCloud& cloud, const Neighbours& neighbours);

}  // namespace gigaray
