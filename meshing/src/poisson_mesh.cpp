// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <CGAL/compute_average_spacing.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <string>

#include "cgal_mesh.h"
#include "cloud_mesh.h"
#include "gigaray/error.h"
#include "gigaray/meshing/cloud_mesh.h"

namespace gigaray {

SurfaceMesh poisson_mesh(const PointCloud& cloud, const PoissonOptions& options) {
  if (!(options.spacing > 0) || !(options.trim >= 0))
    throw Error(ErrorCode::kInvalidArgument,
                "a Poisson surface needs a spacing above 0 and a trim of 0 or more, not " +
                    std::to_string(options.spacing) + " and " + std::to_string(options.trim));
  check_cloud(cloud);
  using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  std::vector<Oriented> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f &p = cloud.positions[i], &n = cloud.normals[i];
    points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()),
                        Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  const CGAL::First_of_pair_property_map<Oriented> point_map;
  const double spacing =
      options.spacing * CGAL::compute_average_spacing<CGAL::Sequential_tag>(
                            points, kSpacingNeighbour, CGAL::parameters::point_map(point_map));
  CgalMesh found;
  const bool done =
      spacing > 0 && CGAL::poisson_surface_reconstruction_delaunay(
                         points.begin(), points.end(), point_map,
                         CGAL::Second_of_pair_property_map<Oriented>(), found, spacing);
  if (!done) throw Error(ErrorCode::kBadInput, "the points and their normals give no surface");

  const Neighbours neighbours(cloud.positions);
  const std::vector<float> reach = neighbours.spacing(kSpacingNeighbour);
  found.add_property_map<CgalMesh::Vertex_index, Rgb8>("v:colour");
  SurfaceMesh mesh = surface_mesh_of(found);
  std::vector<std::uint8_t> is_supported(mesh.positions.size(), 1);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.colours[i] = colour_at(mesh.positions[i], cloud, neighbours);
    if (options.trim == 0) continue;
    const Neighbours::Found near = neighbours.nearest(mesh.positions[i], 1).front();
    is_supported[i] = near.distance <= options.trim * reach[near.index];
  }
  std::erase_if(mesh.faces, [&](const auto& face) {
    return !std::ranges::all_of(face, [&](std::uint32_t i) { return is_supported[i] != 0; });
  });
  turn_to_normals(mesh, cloud, neighbours);
  return mesh;
}

}  // namespace gigaray
