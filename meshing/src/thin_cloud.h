// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/point_cloud.h"

namespace gigaray {

// The steps of merging, each by PCL. Positions should be near the origin: they are float.

/// The points of every cube with side `voxel` as one, its attributes their means. The cubes have
/// the origin at a corner. Fewer than 2^31 cubes must hold the bounding box.
PointCloud merge_points(const PointCloud& cloud, double voxel);

/// 1 for points whose mean distance to `neighbours` others is at most the mean over the cloud plus
/// so many standard deviations.
std::vector<std::uint8_t> points_in_company(const PointCloud& cloud, int neighbours,
                                            double deviations);

/// Normals of the planes through `neighbours` points, to the side of the normals before.
void smooth_normals(PointCloud& cloud, int neighbours);

}  // namespace gigaray
