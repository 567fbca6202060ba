// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <CGAL/Advancing_front_surface_reconstruction.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "cgal_mesh.h"
#include "cloud_mesh.h"
#include "gigaray/core/error.h"
#include "gigaray/meshing/cloud_mesh.h"

namespace gigaray {
namespace {

/// Keeps triangles from being made that have an edge longer than allowed at its ends. Stops the
/// work when it is cancelled.
class ShortEdges {
 public:
  ShortEdges(const PointCloud& cloud, std::vector<float> longest, const RunControl& control)
      : cloud_(cloud), longest_(std::move(longest)), control_(control) {}

  bool allows(std::size_t a, std::size_t b) const {
    return (cloud_.positions[a] - cloud_.positions[b]).norm() <= std::min(longest_[a], longest_[b]);
  }

  template <class Reconstruction, class Cell>
  double operator()(const Reconstruction& reconstruction, Cell& cell, const int& index) const {
    control_.throw_if_cancelled();
    std::array<std::size_t, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = cell->vertex((index + k + 1) % 4)->info();
    for (int k = 0; k < 3; ++k)
      if (!allows(corners[k], corners[(k + 1) % 3])) return std::numeric_limits<double>::infinity();
    return reconstruction.smallest_radius_delaunay_sphere(cell, index);
  }

 private:
  const PointCloud& cloud_;
  std::vector<float> longest_;
  const RunControl& control_;
};

}  // namespace

SurfaceMesh advancing_front_mesh(const PointCloud& cloud, const AdvancingFrontOptions& options,
                                 const RunControl& control) {
  if (!(options.longest_edge > 0))
    throw Error(ErrorCode::kInvalidArgument,
                "the longest edge must be above 0, not " + std::to_string(options.longest_edge));
  check_cloud(cloud);
  const Neighbours neighbours(cloud.positions);
  std::vector<float> longest = neighbours.spacing();
  for (float& length : longest) length *= float(options.longest_edge);
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3f& p : cloud.positions) points.emplace_back(p.x(), p.y(), p.z());

  SurfaceMesh mesh;
  mesh.origin = cloud.origin;
  mesh.positions = cloud.positions;
  mesh.colours = cloud.colours;
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(faces),
                                               ShortEdges(cloud, std::move(longest), control));
  if (faces.empty()) throw Error(ErrorCode::kBadInput, "the points give no surface");
  for (const auto& face : faces)
    mesh.faces.push_back({std::uint32_t(face[0]), std::uint32_t(face[1]), std::uint32_t(face[2])});
  turn_to_normals(mesh, cloud, neighbours);
  return mesh;
}

}  // namespace gigaray
