// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "witness.h"

#include <algorithm>
#include <cmath>

#include "gigaray/meshing/depth_view.h"

namespace gigaray {

Sight sight_of(const Camera& camera, const FloatMap& inverse_depth, const Eigen::Vector3d& point,
               float between_views, float between_pixels) {
  const Eigen::Vector3d place = camera.project(point);
  const int width = inverse_depth.width(), height = inverse_depth.height();
  if (!(place.z() > 0 && place.x() > -0.5 && place.y() > -0.5 && place.x() < width - 0.5 &&
        place.y() < height - 0.5))
    return Sight::kNothing;
  const int u = int(std::floor(place.x())), v = int(std::floor(place.y()));
  const int u0 = std::max(u, 0), u1 = std::min(u + 1, width - 1);
  const int v0 = std::max(v, 0), v1 = std::min(v + 1, height - 1);
  const float corners[] = {inverse_depth(u0, v0), inverse_depth(u1, v0), inverse_depth(u0, v1),
                           inverse_depth(u1, v1)};
  const float here = float(1 / place.z());
  bool is_seen = false, is_farther = true, is_nearer = true, is_known = true;
  for (const float there : corners) {
    is_seen |= std::abs(there - here) <= between_views;
    is_farther &= there < here - between_views;
    is_nearer &= there > here + between_views;
    is_known &= there > 0;
  }
  if (is_seen) return Sight::kSees;
  if (is_farther) return Sight::kSeesThrough;
  if (!is_known || is_nearer) return Sight::kNothing;
  const auto [least, most] = std::ranges::minmax(corners);
  const bool is_one = is_one_surface(least, most, 0.5 * camera.focal_u, between_pixels);
  return is_one && least <= here && here <= most ? Sight::kSees : Sight::kUnclear;
}

}  // namespace gigaray
