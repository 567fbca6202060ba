// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/point_cloud.h"

namespace GIGARAY_API gigaray {

/// A surface of triangles. Attributes of vertices are equally long.
struct SurfaceMesh {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< as PointCloud::origin
  std::vector<Eigen::Vector3f> positions;            ///< scene units, relative to `origin`
  std::vector<Eigen::Vector3f> normals;              ///< unit
  std::vector<Rgb8> colours;
  /// Indices of vertices, counter-clockwise seen from the side that cameras saw.
  std::vector<std::array<std::uint32_t, 3>> faces;
};

}  // namespace gigaray
