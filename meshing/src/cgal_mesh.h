// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "gigaray/core/surface_mesh.h"

namespace gigaray {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The mesh with its colours ("v:colour"), consistently oriented as far as it goes; vertices and
/// edges where the surface branches are made double, so that it is a manifold. Triangles with no
/// area and vertices without a triangle are left out.
CgalMesh cgal_mesh_of(const SurfaceMesh& mesh);

/// The other way; normals are the means of the triangles' by their area.
SurfaceMesh surface_mesh_of(const CgalMesh& mesh);

}  // namespace gigaray
