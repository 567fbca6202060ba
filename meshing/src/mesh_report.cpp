// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/mesh_report.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>

#include <vector>

#include "cgal_mesh.h"

namespace gigaray {

namespace pmp = CGAL::Polygon_mesh_processing;

MeshReport report_of(const SurfaceMesh& surface) {
  MeshReport report;
  CgalMesh mesh = cgal_mesh_of(surface);
  if (mesh.number_of_faces() == 0) return report;
  report.vertices = mesh.number_of_vertices();
  report.faces = mesh.number_of_faces();

  const auto component =
      mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:component").first;
  report.components = pmp::connected_components(mesh, component);
  for (const auto edge : mesh.edges()) report.boundary_edges += mesh.is_border(edge);
  std::vector<CgalMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
  report.boundary_loops = borders.size();
  const auto euler = std::int64_t(report.vertices) - std::int64_t(mesh.number_of_edges()) +
                     std::int64_t(report.faces);
  report.genus = std::size_t(std::int64_t(report.components) -
                             (euler + std::int64_t(report.boundary_loops)) / 2);

  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> crossings;
  pmp::self_intersections(mesh, std::back_inserter(crossings));
  report.self_intersections = crossings.size();
  const bool is_closed = report.boundary_edges == 0;
  report.is_watertight = is_closed && crossings.empty();
  report.area = CGAL::to_double(pmp::area(mesh));
  if (is_closed) report.volume = CGAL::to_double(pmp::volume(mesh));

  Eigen::AlignedBox3f box;
  for (const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    box.extend(Eigen::Vector3f(float(p.x()), float(p.y()), float(p.z())));
  }
  report.least = box.min();
  report.most = box.max();
  return report;
}

}  // namespace gigaray
