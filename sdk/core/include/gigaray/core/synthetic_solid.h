// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "gigaray/core/depth_view.h"

namespace gigaray::solids {

/// Solids of known shape: how far a point is from their surface, negative inside.
struct Solid {
  std::string name;
  std::function<double(const Eigen::Vector3d&)> distance;
};

inline Solid sphere() {
  return {"sphere", [](const Eigen::Vector3d& x) { return x.norm() - 1; }};
}
inline Solid box() {
  return {"box", [](const Eigen::Vector3d& x) {
            const Eigen::Vector3d q = x.cwiseAbs() - Eigen::Vector3d(0.9, 0.6, 0.5);
            return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
          }};
}
/// Two walls that meet at an edge of 120°.
inline Solid tilted_planes() {
  return {"tilted planes", [](const Eigen::Vector3d& x) {
            const double c = std::cos(std::numbers::pi / 6), s = 0.5;
            return -std::max(c * x.z() - s * x.x() - 0.4, c * x.z() + s * x.x() - 0.4);
          }};
}
/// A rod, 1/20 as thick as it is long, before a wall.
inline Solid rod() {
  return {"rod", [](const Eigen::Vector3d& x) {
            const Eigen::Vector3d way(0, std::clamp(x.y(), -0.8, 0.8), -0.4);
            return std::min((x - way).norm() - 0.04, 0.8 - x.z());
          }};
}

/// A camera at `place` that looks at the origin.
inline Camera camera_at(const Eigen::Vector3d& place, int size) {
  Camera camera;
  camera.width = size;
  camera.height = size - size / 8;
  camera.focal_u = camera.focal_v = 1.1 * size;
  camera.centre_u = 0.5 * (camera.width - 1);
  camera.centre_v = 0.5 * (camera.height - 1);
  const Eigen::Vector3d z = -place.normalized();
  const Eigen::Vector3d down =
      std::abs(z.y()) > 0.95 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = down.cross(z).normalized(), y = z.cross(x);
  camera.rotation << x.transpose(), y.transpose(), z.transpose();
  camera.translation = -camera.rotation * place;
  return camera;
}

/// Cameras all around the origin, 3.2 away, evenly spread.
inline std::vector<Camera> cameras_all_around(int count, int size) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - y * y);
    cameras.push_back(camera_at(
        3.2 * Eigen::Vector3d(radius * std::cos(angle), y, radius * std::sin(angle)), size));
  }
  return cameras;
}

/// Cameras on an arc before the origin, which they look at from z = −3.2.
inline std::vector<Camera> cameras_on_an_arc(int count, int size) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.35 * (2.0 * i / std::max(count - 1, 1) - 1);
    cameras.push_back(
        camera_at(3.2 * Eigen::Vector3d(std::sin(angle), 0.05 * (i % 3), -std::cos(angle)), size));
  }
  return cameras;
}

/// Errors that depth maps have.
struct DepthErrors {
  double noise = 0;     ///< standard deviation of the inverse depth, of its value
  double outliers = 0;  ///< share of pixels with a depth that means nothing
};

/// Depth maps of a solid, exact but for `errors`; colours tell the place: red x, green y, blue z,
/// from −1 to 1.
inline DepthViews views_of(const Solid& solid, std::vector<Camera> cameras,
                           DepthErrors errors = {}) {
  DepthViews views;
  views.cameras = cameras;
  views.read = [solid, cameras, errors](int index) {
    const Camera& camera = cameras[index];
    DepthView view{camera, Image<std::uint16_t>(camera.width, camera.height, 3),
                   FloatMap(camera.width, camera.height, 1, kNoEstimate),
                   FloatMap(camera.width, camera.height, 1, 1.0f)};
    std::mt19937 random(unsigned(index + 1));
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        double z = 0.5;
        const Eigen::Vector3d step = camera.back_project(u, v, 1) - camera.position();
        double gap = 1;
        for (int i = 0; i < 200 && z < 60 && std::abs(gap) > 1e-6; ++i) {
          gap = solid.distance(camera.position() + z * step);
          z += gap / step.norm();
        }
        if (std::abs(gap) > 1e-4) continue;
        const Eigen::Vector3d place = camera.position() + z * step;
        double w = 1 / z;
        if (errors.noise > 0) w *= 1 + errors.noise * normal(random);
        if (errors.outliers > 0 && uniform(random) < errors.outliers)
          w = 0.2 + 0.4 * uniform(random);
        view.inverse_depth(u, v) = float(w);
        for (int k = 0; k < 3; ++k)
          view.picture(u, v, k) = std::uint8_t(std::clamp(127.5 * (1 + place[k]), 0.0, 255.0));
      }
    return view;
  };
  return views;
}

/// How far points are from the surface: mean and 95th percentile.
struct Distances {
  double mean = 0, most = 0;
};
inline Distances distances_to(const Solid& solid, const std::vector<Eigen::Vector3f>& points) {
  std::vector<double> gaps;
  for (const Eigen::Vector3f& point : points)
    gaps.push_back(std::abs(solid.distance(point.cast<double>())));
  std::ranges::sort(gaps);
  Distances result;
  for (const double gap : gaps) result.mean += gap / double(gaps.size());
  if (!gaps.empty()) result.most = gaps[std::size_t(0.95 * double(gaps.size() - 1))];
  return result;
}

}  // namespace gigaray::solids
