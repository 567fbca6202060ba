// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "neighbours.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <cmath>

#include "gigaray/parallel.h"

namespace gigaray {

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

std::vector<float> Neighbours::spacing(int count) const {
  std::vector<float> distances(tree_->points->size());
  constexpr std::size_t kPart = 4096;
  parallel_for(
      int((distances.size() + kPart - 1) / kPart),
      [&](int part) {
        const std::size_t begin = part * kPart, end = std::min(begin + kPart, distances.size());
        for (std::size_t i = begin; i < end; ++i)
          distances[i] = nearest((*tree_->points)[i].getVector3fMap(), count + 1).back().distance;
      },
      [](int) {});
  return distances;
}

}  // namespace gigaray
