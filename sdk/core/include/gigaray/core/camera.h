// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// Closed range of inverse depths 1/z, 1/scene unit; 0 is infinity. min < max.
struct InverseDepthRange {
  double min = 0;
  double max = 0;
  bool operator==(const InverseDepthRange&) const = default;
};

/// A pinhole camera without distortion, posed in a scene. The one convention inside; every adapter
/// converts to it:
/// - x to the right of the picture, y down, z along the view (COLMAP, OpenCV);
/// - a scene point X is at x = rotation · X + translation in the camera, its depth is x_z, and it
///   is seen at u = focal_u · x_x / x_z + centre_u, v = focal_v · x_y / x_z + centre_v;
/// - pixel centres are at integers: the middle of the first pixel is (0, 0). COLMAP, nerfstudio
///   and Middlebury's later sets put it at (0.5, 0.5).
struct Camera {
  int width = 0, height = 0;          ///< px of its own picture; may be smaller than LightField's
  double focal_u = 0, focal_v = 0;    ///< px, > 0
  double centre_u = 0, centre_v = 0;  ///< px
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< scene → camera
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< scene units
  /// Of what this camera sees, if the input says so (sparse points, near and far plane).
  std::optional<InverseDepthRange> inverse_depth;

  Eigen::Vector3d position() const { return -rotation.transpose() * translation; }
  Eigen::Vector3d direction() const { return rotation.row(2).transpose(); }  ///< unit, scene frame

  /// (u, v, z) of a scene point; u and v mean nothing when z ≤ 0.
  Eigen::Vector3d project(const Eigen::Vector3d& point) const;
  /// The scene point at depth z > 0 on the ray of (u, v).
  Eigen::Vector3d back_project(double u, double v, double z) const;
  bool sees(const Eigen::Vector3d& point) const;  ///< before the camera and inside its picture
};

/// Throws Error(kBadInput) with `name` when a number is not finite, a size or focal length is not
/// positive, the rotation is none, or the range is empty.
void check(const Camera& camera, const std::string& name);

/// The range that holds those of all cameras, each of which has one.
InverseDepthRange all_inverse_depths(const std::vector<Camera>& cameras);

/// What to search around points: a fifth of their range more, and at most 1.5 times the farthest.
InverseDepthRange widened(const InverseDepthRange& seen);

/// Range of the inverse depths of points that a view sees: robust percentiles (0.5 … 99.5 %),
/// widened. Empty for fewer than 8 points. depths: of the points, scene units, > 0.
std::optional<InverseDepthRange> range_of_depths(std::vector<double> depths);

}  // namespace gigaray
