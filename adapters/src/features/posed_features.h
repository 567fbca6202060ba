// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "features/view_features.h"
#include "gigaray/core/camera.h"

namespace gigaray {

/// Two posed views, for features of one that are looked for in the other.
class PosedPair {
 public:
  PosedPair(const Camera& from, const Camera& to);

  /// Where the other view sees the point of a pixel at an inverse depth, and how far that moves per
  /// inverse depth, px. False: behind it.
  bool locate(const cv::Point2f& pixel, double inverse_depth, Eigen::Vector2d& there,
              double& speed) const;
  /// The inverse depth of `pixel` whose point is seen nearest to the line of sight of `there`.
  /// Below 0: beyond infinity.
  double inverse_depth(const cv::Point2f& pixel, const cv::Point2f& there) const;
  /// Line of `pixel` in the other view: l · (u, v, 1) is the distance to it in px.
  Eigen::Vector3d epipolar_line(const cv::Point2f& pixel) const;

 private:
  Camera from_, to_;
  Eigen::Matrix3d turn_;
  Eigen::Vector3d shift_;
};

/// Indices of features of a and b that resemble each other most of those on their epipolar lines,
/// before both cameras, clearly more than the second, and both ways. Empty when there are hardly
/// more of them than beside the lines, where chance alone finds some. tolerance: px of the view.
std::vector<std::pair<int, int>> matches_on_lines(const Camera& camera_a, const ViewFeatures& a,
                                                  const Camera& camera_b, const ViewFeatures& b,
                                                  double tolerance);

}  // namespace gigaray
