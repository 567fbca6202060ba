// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>

#include "gigaray/core/api.h"
#include "gigaray/core/surface_mesh.h"

namespace GIGARAY_API gigaray {

struct MeshCleaning {
  std::size_t least_faces = 50;  ///< Pieces with fewer are dropped, save those on a larger one.
  int hole_edges = 0;            ///< Holes with up to so many edges are filled; 0: none
  std::size_t most_faces = 0;    ///< Edges are collapsed until so many triangles are left; 0: none
};

struct MeshCleaned {
  std::size_t pieces_dropped = 0, holes_filled = 0;
};

/// The mesh as a manifold whose pieces are consistently oriented, cleaned, with normals of its
/// triangles (CGAL; Lindstrom and Turk 1999 for the collapse). May be empty when all pieces are
/// small. done: what was done, may be null.
SurfaceMesh cleaned(const SurfaceMesh& mesh, const MeshCleaning& cleaning, MeshCleaned* done);

}  // namespace gigaray
