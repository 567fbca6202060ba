// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/mesh_processing.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <vector>

#include "cgal_mesh.h"

namespace gigaray {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

std::size_t fill_holes(CgalMesh& mesh, int most_edges) {
  std::vector<CgalMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
  std::size_t filled = 0;
  for (const auto border : borders) {
    int edges = 0;
    for (auto edge = border; edges <= most_edges; edge = mesh.next(edge)) {
      ++edges;
      if (mesh.next(edge) == border) break;
    }
    if (edges > most_edges) continue;
    std::vector<CgalMesh::Face_index> patch;
    pmp::triangulate_hole(mesh, border, std::back_inserter(patch));
    filled += !patch.empty();
  }
  return filled;
}

/// A triangle mesh has one and a half times as many edges as faces.
void simplify(CgalMesh& mesh, std::size_t most_faces) {
  namespace sms = CGAL::Surface_mesh_simplification;
  if (mesh.number_of_faces() <= most_faces) return;
  const auto edges = std::size_t(double(mesh.number_of_edges()) * double(most_faces) /
                                 double(mesh.number_of_faces()));
  sms::edge_collapse(mesh, sms::Count_stop_predicate<CgalMesh>(edges));
}

}  // namespace

SurfaceMesh cleaned(const SurfaceMesh& mesh, const MeshCleaning& cleaning, MeshCleaned* done) {
  CgalMesh result = cgal_mesh_of(mesh);
  MeshCleaned report;
  report.pieces_dropped =
      pmp::keep_large_connected_components(result, std::max<std::size_t>(cleaning.least_faces, 1));
  if (cleaning.hole_edges > 0) report.holes_filled = fill_holes(result, cleaning.hole_edges);
  if (cleaning.most_faces > 0) simplify(result, cleaning.most_faces);
  if (done) *done = report;
  return surface_mesh_of(result);
}

}  // namespace gigaray
