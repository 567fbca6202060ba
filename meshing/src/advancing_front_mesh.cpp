// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <CGAL/Advancing_front_surface_reconstruction.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cgal_mesh.h"
#include "cloud_mesh.h"
#include "gigaray/error.h"
#include "gigaray/meshing/cloud_mesh.h"

namespace gigaray {
SurfaceMesh advancing_front_mesh(const PointCloud& cloud, const AdvancingFrontOptions& options) {
  if (!(options.longest_edge > 0))
    throw Error(ErrorCode::kInvalidArgument,
                "the longest edge must be above 0, not " + std::to_string(options.longest_edge));
  check_cloud(cloud);
  const Neighbours neighbours(cloud.positions);
  std::vector<float> longest = neighbours.spacing(kSpacingNeighbour);
  for (float& length : longest) length *= float(options.longest_edge);
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3f& p : cloud.positions) points.emplace_back(p.x(), p.y(), p.z());

  SurfaceMesh mesh;
  mesh.positions = cloud.positions;
  mesh.colours = cloud.colours;
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(faces));
  // Not as the priority of the front: a front that stops everywhere begins anew as often, and each
  // time CGAL looks at all triangles.
  const auto is_short = [&](std::size_t a, std::size_t b) {
    return (cloud.positions[a] - cloud.positions[b]).norm() <= std::min(longest[a], longest[b]);
  };
  std::erase_if(faces, [&](const auto& face) {
    return !is_short(face[0], face[1]) || !is_short(face[1], face[2]) ||
           !is_short(face[2], face[0]);
  });
  if (faces.empty()) throw Error(ErrorCode::kBadInput, "the points give no surface");
  for (const auto& face : faces)
    mesh.faces.push_back({std::uint32_t(face[0]), std::uint32_t(face[1]), std::uint32_t(face[2])});
  turn_to_normals(mesh, cloud, neighbours);
  return mesh;
}

}  // namespace gigaray
