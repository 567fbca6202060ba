// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "neighbours.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>

#include "gigaray/core/parallel.h"

namespace gigaray {

namespace {

/// work(i) for all i below count, on all cores.
template <class Work>
void in_parts(std::size_t count, Work work) {
  constexpr std::size_t kPart = 4096;
  parallel_for(
      int((count + kPart - 1) / kPart),
      [&](int part) {
        for (std::size_t i = part * kPart; i < std::min((part + 1) * kPart, count); ++i) work(i);
      },
      [](int) {});
}

}  // namespace

struct Neighbours::Tree {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::KdTreeFLANN<pcl::PointXYZ> search;
};

Neighbours::Neighbours(const std::vector<Eigen::Vector3f>& points)
    : tree_(std::make_unique<Tree>()) {
  tree_->points->reserve(points.size());
  for (const Eigen::Vector3f& p : points) tree_->points->emplace_back(p.x(), p.y(), p.z());
  tree_->search.setInputCloud(tree_->points);
}

Neighbours::~Neighbours() = default;

std::vector<Neighbours::Found> Neighbours::nearest(const Eigen::Vector3f& place, int count) const {
  pcl::Indices indices;
  std::vector<float> squares;
  const int number =
      tree_->search.nearestKSearch({place.x(), place.y(), place.z()}, count, indices, squares);
  std::vector<Found> found;
  for (int i = 0; i < number; ++i)
    found.push_back({std::size_t(indices[i]), std::sqrt(squares[i])});
  return found;
}

std::vector<float> Neighbours::spacing() const {
  constexpr int kNeighbour = 6, kCrowd = 32;
  const std::size_t count = tree_->points->size();
  const auto around = [&](std::size_t i, int number) {
    return nearest((*tree_->points)[i].getVector3fMap(), number + 1);
  };
  std::vector<float> distance(count), spacing(count);
  in_parts(count, [&](std::size_t i) { distance[i] = around(i, kNeighbour).back().distance; });
  in_parts(count, [&](std::size_t i) {
    std::vector<float> others;
    for (const Found& found : around(i, kCrowd)) others.push_back(distance[found.index]);
    const auto low = others.begin() + std::ptrdiff_t(others.size() / 4);
    std::nth_element(others.begin(), low, others.end());
    spacing[i] = std::min(distance[i], 2 * *low);
  });
  return spacing;
}

}  // namespace gigaray
