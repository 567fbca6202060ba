// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "witness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gigaray/meshing/depth_view.h"

namespace gigaray {

namespace {

struct Corners {
  std::array<float, 4> inverse_depth;  ///< of (0, 0), (1, 0), (0, 1), (1, 1)
  double u, v;                         ///< place between them, 0 … 1
};

Corners corners_of(const FloatMap& map, double u, double v) {
  const int left = int(std::floor(u)), top = int(std::floor(v));
  const int u0 = std::max(left, 0), u1 = std::min(left + 1, map.width() - 1);
  const int v0 = std::max(top, 0), v1 = std::min(top + 1, map.height() - 1);
  return {{map(u0, v0), map(u1, v0), map(u0, v1), map(u1, v1)}, u - left, v - top};
}

float interpolated(const Corners& c) {
  const auto& w = c.inverse_depth;
  return float((1 - c.v) * ((1 - c.u) * w[0] + c.u * w[1]) + c.v * ((1 - c.u) * w[2] + c.u * w[3]));
}

float nearest(const Corners& c, float here) {
  return std::ranges::min(c.inverse_depth, {}, [&](float w) {
    return std::isnan(w) ? std::numeric_limits<float>::infinity() : std::abs(w - here);
  });
}

}  // namespace

Look look_at(const Camera& camera, const FloatMap& inverse_depth, const Eigen::Vector3d& point,
             float between_views, float between_pixels) {
  const Eigen::Vector3d place = camera.project(point);
  if (!(place.z() > 0 && place.x() > -0.5 && place.y() > -0.5 &&
        place.x() < inverse_depth.width() - 0.5 && place.y() < inverse_depth.height() - 0.5))
    return {};
  const Corners corners = corners_of(inverse_depth, place.x(), place.y());
  const float here = float(1 / place.z());
  bool is_seen = false, is_farther = true, is_nearer = true, is_known = true;
  for (const float there : corners.inverse_depth) {
    is_seen |= std::abs(there - here) <= between_views;
    is_farther &= there < here - between_views;
    is_nearer &= there > here + between_views;
    is_known &= there > 0;
  }
  if (is_farther) return {Sight::kSeesThrough};
  if (!is_seen && (!is_known || is_nearer)) return {};
  const auto [least, most] = std::ranges::minmax(corners.inverse_depth);
  const bool is_one = is_known && is_one_surface(least, most, 0.5 * camera.focal_u, between_pixels);
  const bool is_between = is_one && least <= here && here <= most;
  return {is_seen || is_between ? Sight::kSees : Sight::kUnclear,
          (is_one ? interpolated(corners) : nearest(corners, here)) / here,
          is_known ? (most - least) / here : std::numeric_limits<float>::infinity()};
}

}  // namespace gigaray
