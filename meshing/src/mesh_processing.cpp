// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/mesh_processing.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <array>
#include <vector>

#include "cgal_mesh.h"
#include "neighbours.h"

namespace gigaray {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Drops pieces with fewer faces, but not patches that lie on a larger piece, such as close holes
/// of it: more than half of their corners are no farther from it than their triangles are long.
/// Returns how many were dropped.
std::size_t drop_small_pieces(CgalMesh& mesh, std::size_t least_faces) {
  auto piece_of = mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:piece").first;
  const std::size_t pieces = pmp::connected_components(mesh, piece_of);
  std::vector<std::size_t> faces(pieces), near(pieces);
  for (const auto face : mesh.faces()) ++faces[piece_of[face]];
  const auto is_large = [&](CgalMesh::Face_index face) {
    return faces[piece_of[face]] >= least_faces;
  };
  const auto corners_of = [&](CgalMesh::Face_index face) {
    std::array<Eigen::Vector3f, 3> corners;
    auto corner = corners.begin();
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
      const Kernel::Point_3& p = mesh.point(vertex);
      *corner++ = {float(p.x()), float(p.y()), float(p.z())};
    }
    return corners;
  };

  std::vector<Eigen::Vector3f> large;
  for (const auto face : mesh.faces())
    if (is_large(face)) std::ranges::copy(corners_of(face), std::back_inserter(large));
  if (!large.empty() && large.size() < 3 * mesh.number_of_faces()) {
    const Neighbours neighbours(large);
    for (const auto face : mesh.faces()) {
      if (is_large(face)) continue;
      const auto [a, b, c] = corners_of(face);
      const float length = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
      for (const Eigen::Vector3f& corner : {a, b, c})
        near[piece_of[face]] += neighbours.nearest(corner, 1).front().distance <= length;
    }
  }
  std::vector<std::size_t> dropped;
  for (std::size_t piece = 0; piece < pieces; ++piece)
    if (faces[piece] < least_faces && 2 * near[piece] <= 3 * faces[piece]) dropped.push_back(piece);
  pmp::remove_connected_components(mesh, dropped, piece_of);
  mesh.remove_property_map(piece_of);
  return dropped.size();
}

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
  report.pieces_dropped = drop_small_pieces(result, cleaning.least_faces);
  if (cleaning.hole_edges > 0) report.holes_filled = fill_holes(result, cleaning.hole_edges);
  if (cleaning.most_faces > 0) simplify(result, cleaning.most_faces);
  if (done) *done = report;
  SurfaceMesh surface = surface_mesh_of(result);
  surface.origin = mesh.origin;
  return surface;
}

}  // namespace gigaray
