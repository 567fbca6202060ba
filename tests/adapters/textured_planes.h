// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "gigaray/core/camera.h"
#include "support/cameras.h"

namespace gigaray {

/// Value noise of several sizes: corners and blobs at every scale, the same at every call.
inline double noise_texture(double x, double y, std::uint32_t seed) {
  const auto at = [&](std::int64_t i, std::int64_t j, std::uint32_t octave) {
    std::uint64_t h = std::uint64_t(i) * 0x9e3779b97f4a7c15u ^
                      std::uint64_t(j) * 0xc2b2ae3d27d4eb4fu ^ (seed * 31u + octave);
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
    return double(h >> 40) / double(1 << 24);
  };
  double sum = 0, weight = 0;
  for (std::uint32_t octave = 0; octave < 4; ++octave, x *= 2.1, y *= 2.1) {
    const double fx = std::floor(x), fy = std::floor(y), a = x - fx, b = y - fy;
    const auto i = std::int64_t(fx), j = std::int64_t(fy);
    sum += (1 - a) * ((1 - b) * at(i, j, octave) + b * at(i, j + 1, octave)) +
           a * ((1 - b) * at(i + 1, j, octave) + b * at(i + 1, j + 1, octave));
    weight += 1;
  }
  const double value = (sum / weight - 0.5) * 2.2 + 0.5;
  return value < 0 ? 0 : value > 1 ? 1 : value;
}

/// Upright planes at z = 4, 5.5 and 7 (the last without end) that a camera looks at from z = 0;
/// 2 x 2 samples per pixel.
inline cv::Mat textured_planes(const Camera& camera) {
  struct Plane {
    double z, left, right, top, bottom;
  };
  constexpr Plane kPlanes[] = {
      {4, -1.2, -0.2, -0.9, 0.7}, {5.5, 0.3, 1.6, -0.6, 1.1}, {7, -1e9, 1e9, -1e9, 1e9}};
  constexpr double kCellsPerUnit = 4;
  const auto colour = [&](double u, double v) {
    const Eigen::Vector3d eye = camera.position();
    const Eigen::Vector3d ray = camera.back_project(u, v, 1) - eye;
    for (const Plane& plane : kPlanes) {
      const Eigen::Vector3d at = eye + ray * ((plane.z - eye.z()) / ray.z());
      if (at.x() >= plane.left && at.x() <= plane.right && at.y() >= plane.top &&
          at.y() <= plane.bottom)
        return noise_texture(kCellsPerUnit * at.x(), kCellsPerUnit * at.y(),
                             std::uint32_t(10 * plane.z));
    }
    return 0.0;
  };
  cv::Mat picture(camera.height, camera.width, CV_8UC3);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      double sum = 0;
      for (const double dv : {-0.25, 0.25})
        for (const double du : {-0.25, 0.25}) sum += colour(u + du, v + dv);
      const auto value = std::uint8_t(std::lround(255 * sum / 4));
      picture.at<cv::Vec3b>(v, u) = {value, value, value};
    }
  return picture;
}

/// Cameras of 400 x 300 px on an arc before the planes, each turned towards them.
inline std::vector<Camera> cameras_before_planes(int count) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    Camera camera = testing_support::centred_camera(400, 300, 380);
    const double x = 0.35 * (i - (count - 1) / 2.0), y = i % 2 ? 0.2 : -0.15;
    camera.rotation = Eigen::AngleAxisd(std::atan(x / 5.5), Eigen::Vector3d::UnitY()).matrix() *
                      Eigen::AngleAxisd(0.02 * (i % 3), Eigen::Vector3d::UnitZ()).matrix();
    camera.translation = -camera.rotation * Eigen::Vector3d(x, y, 0.05 * i);
    cameras.push_back(camera);
  }
  return cameras;
}

}  // namespace gigaray
