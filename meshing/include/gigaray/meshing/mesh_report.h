// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

#include "gigaray/core/api.h"
#include "gigaray/core/surface_mesh.h"

namespace GIGARAY_API gigaray {

/// Shape of a surface.
struct MeshReport {
  std::size_t vertices = 0, faces = 0;
  std::size_t components = 0;      ///< connected pieces
  std::size_t boundary_edges = 0;  ///< edges with a triangle on one side alone
  std::size_t boundary_loops = 0;
  /// Handles of all pieces: C − (V − E + F + B) / 2 with C pieces and B boundary loops.
  std::size_t genus = 0;
  std::size_t self_intersections = 0;  ///< pairs of triangles that cut each other
  bool is_watertight = false;          ///< no boundary, no self-intersection
  double area = 0;                     ///< scene units²
  std::optional<double> volume;        ///< scene units³, of a surface without boundary
  /// Box around the positions, relative to the origin of the mesh.
  Eigen::Vector3f least = Eigen::Vector3f::Zero(), most = Eigen::Vector3f::Zero();
};

/// The surface is looked at as `cleaned` makes it a manifold. An empty one gives zeros.
MeshReport report_of(const SurfaceMesh& mesh);

}  // namespace gigaray
