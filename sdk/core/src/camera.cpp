// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {

Eigen::Vector3d Camera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d x = rotation * point + translation;
  return {focal_u * x.x() / x.z() + centre_u, focal_v * x.y() / x.z() + centre_v, x.z()};
}

Eigen::Vector3d Camera::back_project(double u, double v, double z) const {
  const Eigen::Vector3d ray((u - centre_u) / focal_u, (v - centre_v) / focal_v, 1);
  return rotation.transpose() * (z * ray - translation);
}

bool Camera::sees(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d at = project(point);
  return at.z() > 0 && at.x() >= 0 && at.x() <= width - 1 && at.y() >= 0 && at.y() <= height - 1;
}

void check(const Camera& camera, const std::string& name) {
  const auto bad = [&](const std::string& what) {
    throw Error(ErrorCode::kBadInput, name + ": " + what);
  };
  const double numbers[] = {camera.focal_u, camera.focal_v, camera.centre_u, camera.centre_v};
  if (!std::all_of(std::begin(numbers), std::end(numbers),
                   [](double x) { return std::isfinite(x); }))
    bad("a focal length or principal point is not a finite number");
  if (!camera.rotation.allFinite() || !camera.translation.allFinite())
    bad("its pose holds a number that is not finite");
  if (camera.width < 1 || camera.height < 1) bad("its picture is empty");
  if (!(camera.focal_u > 0 && camera.focal_v > 0)) bad("its focal length is not positive");
  constexpr double kOrthonormal = 1e-4;
  const Eigen::Matrix3d square = camera.rotation * camera.rotation.transpose();
  if ((square - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kOrthonormal ||
      camera.rotation.determinant() < 0)
    bad("its rotation is none (not orthonormal, or mirrored)");
  if (const auto& range = camera.inverse_depth;
      range && !(range->min < range->max && std::isfinite(range->min) && std::isfinite(range->max)))
    bad("its range of depths is empty");
}

InverseDepthRange all_inverse_depths(const std::vector<Camera>& cameras) {
  require_argument(!cameras.empty() && cameras.front().inverse_depth,
                   "cameras: each needs its inverse_depth, there must be one");
  InverseDepthRange all = *cameras.front().inverse_depth;
  for (const Camera& camera : cameras) {
    require_argument(camera.inverse_depth.has_value(), "cameras: each needs its inverse_depth");
    all.min = std::min(all.min, camera.inverse_depth->min);
    all.max = std::max(all.max, camera.inverse_depth->max);
  }
  return all;
}

InverseDepthRange widened(const InverseDepthRange& seen) {
  constexpr double kMargin = 0.2;
  constexpr double kFarther = 1.5;    // times the farthest depth, at most
  constexpr double kInfinity = 0.01;  // of the nearest: as good as none
  // Points of one depth alone still leave something to search.
  const double margin = std::max(kMargin * (seen.max - seen.min), 0.02 * seen.max);
  if (seen.min < kInfinity * seen.max) return {0, seen.max + margin};
  return {std::max(seen.min / kFarther, seen.min - margin), seen.max + margin};
}

std::optional<InverseDepthRange> range_of_depths(std::vector<double> depths) {
  constexpr double kPercentile = 0.005;
  constexpr std::size_t kLeastPoints = 8;
  if (depths.size() < kLeastPoints) return std::nullopt;
  for (double& z : depths) z = 1 / z;
  std::sort(depths.begin(), depths.end());
  const auto percentile = [&](double p) {
    return depths[std::size_t(std::lround(p * double(depths.size() - 1)))];
  };
  return widened({percentile(kPercentile), percentile(1 - kPercentile)});
}

}  // namespace gigaray
