// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace gigaray {

/// Nearest points of a set (PCL's k-d tree).
class Neighbours {
 public:
  explicit Neighbours(const std::vector<Eigen::Vector3f>& points);
  ~Neighbours();

  struct Found {
    std::size_t index;
    float distance;
  };
  /// The nearest ones first; fewer when there are fewer.
  std::vector<Found> nearest(const Eigen::Vector3f& place, int count) const;

  /// Of every point how far points are apart there: the distance to its sixth neighbour, but at
  /// most twice what a quarter of the nearest 32 have, lest a few stray points reach far.
  std::vector<float> spacing() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace gigaray
