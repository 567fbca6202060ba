// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rail.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "gigaray/core/arguments.h"

namespace gigaray {

Eigen::Vector2d RadialLens::project(const Eigen::Vector2d& direction) const {
  const double r2 = direction.squaredNorm();
  return focal * (1 + r2 * (k1 + r2 * k2)) * direction + centre;
}

bool RadialLens::sees(const Eigen::Vector2d& direction) const {
  // The slope 1 + 3 k1 r² + 5 k2 r⁴ stays positive from the axis to here: at both ends, and at its
  // lowest place if that lies between.
  const double r2 = direction.squaredNorm();
  const auto slope = [&](double x) { return 1 + x * (3 * k1 + x * 5 * k2); };
  const double lowest = k2 > 0 ? -0.3 * k1 / k2 : 0;
  return slope(r2) > 0 && (lowest <= 0 || lowest >= r2 || slope(lowest) > 0);
}

Eigen::Vector2d RadialLens::direction(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen = (pixel - centre) / focal;
  const double target = seen.norm();
  if (target == 0 || (k1 == 0 && k2 == 0)) return seen;
  // Newton's iteration for the radius.
  constexpr int kIterations = 20;
  double r = target;
  for (int i = 0; i < kIterations; ++i) {
    const double r2 = r * r;
    const double slope = 1 + r2 * (3 * k1 + r2 * 5 * k2);
    // Beyond its turning point the model has no inverse; the radius stays where it is.
    if (slope < 0.05) break;
    r -= (r * (1 + r2 * (k1 + r2 * k2)) - target) / slope;
  }
  return seen * (r / target);
}

namespace {

void check_view(const Rail& rail, int view_idx) {
  require_argument(
      view_idx >= 0 && view_idx < rail.num_views() && std::size_t(view_idx) < rail.turns.size(),
      "view_idx: the rail has no such view");
}

Eigen::Vector3d travel_in_common_frame(const Rail& rail) { return rail.rotation * rail.direction; }

}  // namespace

Eigen::Vector2d project(const Rail& rail, int view_idx, const RailPoint& point) {
  check_view(rail, view_idx);
  const Eigen::Vector3d ray =
      rail.turns[view_idx] *
      (point.direction.homogeneous() -
       point.inverse_depth * rail.positions[view_idx] * travel_in_common_frame(rail));
  return rail.lens.project(ray.hnormalized());
}

RailPoint triangulate(const Rail& rail, const Track& track) {
  // With the turn undone a sighting is a direction (x, y): (a, b, 1) − ρ s e is parallel to it,
  // two equations that are linear in a, b and ρ.
  const Eigen::Vector3d e = travel_in_common_frame(rail);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sighting& sighting : track) {
    check_view(rail, sighting.view_idx);
    const Eigen::Vector2d seen = (rail.turns[sighting.view_idx].transpose() *
                                  rail.lens.direction(sighting.pixel).homogeneous())
                                     .hnormalized();
    const double s = rail.positions[sighting.view_idx];
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Vector3d row = Eigen::Vector3d::Zero();
      row[axis] = 1;
      row[2] = s * (seen[axis] * e.z() - e[axis]);
      normal += row * row.transpose();
      right += row * seen[axis];
    }
  }
  const Eigen::Vector3d solution = normal.colPivHouseholderQr().solve(right);
  return {solution.head<2>(), solution[2]};
}

ResidualStats residual_stats(std::vector<double> lengths) {
  ResidualStats stats;
  stats.count = long(lengths.size());
  if (lengths.empty()) return stats;
  std::sort(lengths.begin(), lengths.end());
  double sum_of_squares = 0;
  for (const double length : lengths) sum_of_squares += length * length;
  stats.rms = std::sqrt(sum_of_squares / double(lengths.size()));
  const auto percentile = [&](double p) {
    return lengths[std::size_t(std::lround(p * double(lengths.size() - 1)))];
  };
  stats.median = percentile(0.5);
  stats.percentile_95 = percentile(0.95);
  return stats;
}

}  // namespace gigaray
