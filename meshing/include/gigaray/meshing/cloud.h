// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <functional>

#include "gigaray/core/api.h"
#include "gigaray/core/point_cloud.h"
#include "gigaray/core/run_control.h"
#include "gigaray/meshing/view_points.h"

namespace GIGARAY_API gigaray {

struct CloudOptions {
  PointOptions points;
  /// Points in a cube with this side become one, scene units; 0: the distance of neighbouring
  /// pixels there, Survey::spacing times a power of two, so that near and far parts keep what was
  /// seen of them.
  double voxel = 0;
  /// Cubes are enlarged until no more points are left than this; 0: any number may be.
  std::size_t most_points = 0;
  /// Points are dropped whose mean distance to their neighbours is larger than usual by so many
  /// standard deviations; 0: none are.
  double outlier_deviations = 3;
  int neighbours = 16;                        ///< of a point, for outliers and normals. ≥ 3
  std::size_t memory = std::size_t(2) << 30;  ///< Bytes of points in memory; more go to a file.
};

struct CloudReport {
  PointCounts pixels;          ///< of all views
  std::uint64_t merged = 0;    ///< points after merging,
  std::uint64_t outliers = 0;  ///< those of them that stand alone,
  std::uint64_t points = 0;    ///< and the rest, which is the cloud
  double voxel = 0;            ///< scene units; with voxels of several sizes the usual one
  int tiles = 0;               ///< cubes that were worked on one after the other
  std::uint64_t bytes_on_disk = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of every tile
};

/// One cloud of all views: points that other views confirm, merged in a grid of voxels, outliers
/// removed, normals of the neighbourhood to the side that cameras saw (all PCL). Works tile by tile
/// of space, relative to an origin near the cameras when these stand far out (`nearby`): `take`
/// gets the points of one after the other, in an order that depends on nothing but the data. Throws
/// Error(kInvalidArgument) for options, Error(kBadInput) when no point is left, Error(kIo) when the
/// disk is full, kCancelled, and what `views` throws.
CloudReport build_cloud(const DepthViews& views, const CloudOptions& options,
                        const std::function<void(const PointCloud& tile)>& take,
                        const RunControl& control);

}  // namespace gigaray
