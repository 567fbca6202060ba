// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "cloud_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

/// Pieces of a mesh: of every face, one face that stands for its piece.
std::vector<std::size_t> pieces_of(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& face : mesh.faces)
    for (int k = 1; k < 3; ++k) parent[root(face[k])] = root(face[0]);
  std::vector<std::size_t> pieces;
  for (const auto& face : mesh.faces) pieces.push_back(root(face[0]));
  return pieces;
}

}  // namespace

void check_cloud(const PointCloud& cloud) {
  constexpr std::size_t kLeast = 10;
  if (cloud.size() < kLeast)
    throw Error(ErrorCode::kBadInput, "a surface needs " + std::to_string(kLeast) +
                                          " points or more, there are " +
                                          std::to_string(cloud.size()));
  require_argument(cloud.normals.size() == cloud.size() && cloud.colours.size() == cloud.size(),
                   "cloud: each point needs a normal and a colour");
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : cloud.positions) {
    if (!position.allFinite()) throw Error(ErrorCode::kBadInput, "a point is not finite");
    box.extend(position);
  }
  if (!(box.diagonal().norm() > 0))
    throw Error(ErrorCode::kBadInput, "all points are at the same place");
}

Rgb8 colour_at(const Eigen::Vector3f& place, const PointCloud& cloud,
               const Neighbours& neighbours) {
  constexpr int kPoints = 4;
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float total = 0;
  for (const Neighbours::Found& found : neighbours.nearest(place, kPoints)) {
    const float weight = 1 / (found.distance + 1e-12f);
    const Rgb8& colour = cloud.colours[found.index];
    sum += weight * Eigen::Array3f(colour[0], colour[1], colour[2]);
    total += weight;
  }
  sum = (sum / total).round();
  return {std::uint8_t(sum[0]), std::uint8_t(sum[1]), std::uint8_t(sum[2])};
}

void turn_to_normals(SurfaceMesh& mesh, const PointCloud& cloud, const Neighbours& neighbours) {
  const std::vector<std::size_t> pieces = pieces_of(mesh);
  std::vector<double> agreement(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto& face = mesh.faces[i];
    const Eigen::Vector3f a = mesh.positions[face[0]], b = mesh.positions[face[1]],
                          c = mesh.positions[face[2]];
    const std::size_t near = neighbours.nearest((a + b + c) / 3, 1).front().index;
    agreement[pieces[i]] += (b - a).cross(c - a).dot(cloud.normals[near]);
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    if (agreement[pieces[i]] < 0) std::swap(mesh.faces[i][1], mesh.faces[i][2]);
}

}  // namespace gigaray
