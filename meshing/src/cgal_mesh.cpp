// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "cgal_mesh.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <Eigen/Geometry>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Remembers which vertex a doubled one was.
struct Origins : pmp::Default_orientation_visitor {
  std::vector<std::size_t>* origins;
  void duplicated_vertex(std::size_t vertex, std::size_t copy) {
    if (origins->size() <= copy) origins->resize(copy + 1);
    (*origins)[copy] = (*origins)[vertex];
  }
};

}  // namespace

CgalMesh cgal_mesh_of(const SurfaceMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::size_t> origins;
  std::vector<std::size_t> place(mesh.positions.size(), std::size_t(-1));
  std::vector<std::array<std::size_t, 3>> polygons;
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d a = mesh.positions[face[0]].cast<double>();
    const Eigen::Vector3d ab = mesh.positions[face[1]].cast<double>() - a;
    const Eigen::Vector3d ac = mesh.positions[face[2]].cast<double>() - a;
    if (!(ab.cross(ac).squaredNorm() > 0)) continue;
    std::array<std::size_t, 3> polygon;
    for (int k = 0; k < 3; ++k) {
      require_argument(face[k] < mesh.positions.size(),
                       "mesh.faces: name a vertex that is not there");
      std::size_t& index = place[face[k]];
      if (index == std::size_t(-1)) {
        index = points.size();
        const Eigen::Vector3f& p = mesh.positions[face[k]];
        points.emplace_back(p.x(), p.y(), p.z());
        origins.push_back(face[k]);
      }
      polygon[k] = index;
    }
    polygons.push_back(polygon);
  }
  Origins visitor;
  visitor.origins = &origins;
  pmp::orient_polygon_soup(points, polygons, CGAL::parameters::visitor(visitor));
  origins.resize(points.size());

  CgalMesh result;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, result);
  GIGARAY_CHECK(result.number_of_vertices() == points.size());
  const auto colours = result.add_property_map<CgalMesh::Vertex_index, Rgb8>("v:colour").first;
  if (!mesh.colours.empty())
    for (const auto vertex : result.vertices())
      colours[vertex] = mesh.colours[origins[std::size_t(vertex)]];
  return result;
}

SurfaceMesh surface_mesh_of(const CgalMesh& mesh) {
  SurfaceMesh result;
  const auto colours = mesh.property_map<CgalMesh::Vertex_index, Rgb8>("v:colour").first;
  std::vector<std::uint32_t> place(mesh.num_vertices());
  for (const auto vertex : mesh.vertices()) {
    place[vertex] = std::uint32_t(result.positions.size());
    const auto& p = mesh.point(vertex);
    result.positions.emplace_back(float(p.x()), float(p.y()), float(p.z()));
    result.colours.push_back(colours[vertex]);
  }
  std::vector<Eigen::Vector3d> normals(result.positions.size(), Eigen::Vector3d::Zero());
  for (const auto face : mesh.faces()) {
    std::array<std::uint32_t, 3> corners;
    int k = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      corners[k++] = place[vertex];
    result.faces.push_back(corners);
    const Eigen::Vector3d a = result.positions[corners[0]].cast<double>();
    const Eigen::Vector3d twice_area = (result.positions[corners[1]].cast<double>() - a)
                                           .cross(result.positions[corners[2]].cast<double>() - a);
    for (const std::uint32_t corner : corners) normals[corner] += twice_area;
  }
  for (const Eigen::Vector3d& normal : normals)
    result.normals.push_back(normal.squaredNorm() > 0
                                 ? Eigen::Vector3f(normal.normalized().cast<float>())
                                 : Eigen::Vector3f(0, 0, -1));
  return result;
}

}  // namespace gigaray
