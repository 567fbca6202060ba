// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "features/agreed_points.h"

#include <cmath>

namespace gigaray {

void AgreedPoints::add(const Camera& camera, const Image<std::uint16_t>& picture, int bit_depth,
                       const FloatMap& depth) {
  constexpr double kMostPoints = 2000;
  Raster raster;
  raster.camera = camera;
  raster.step = int(std::ceil(std::sqrt(double(camera.width) * camera.height / kMostPoints)));
  raster.depth =
      FloatMap(1 + (camera.width - 1) / raster.step, 1 + (camera.height - 1) / raster.step);
  raster.colours = Image<std::uint8_t>(raster.depth.width(), raster.depth.height(), 3);
  for (int v = 0; v < raster.depth.height(); ++v)
    for (int u = 0; u < raster.depth.width(); ++u) {
      raster.depth(u, v) = depth(u * raster.step, v * raster.step);
      for (int c = 0; c < 3; ++c)
        raster.colours(u, v, c) =
            std::uint8_t(picture(u * raster.step, v * raster.step, c) >> (bit_depth - 8));
    }
  rasters_.push_back(std::move(raster));
}

void AgreedPoints::visit(const std::function<void(const AgreedPoint&)>& take) const {
  constexpr double kAgree = 0.02;  // of the depth
  for (const Raster& raster : rasters_)
    for (int v = 0; v < raster.depth.height(); ++v)
      for (int u = 0; u < raster.depth.width(); ++u) {
        if (std::isnan(raster.depth(u, v))) continue;
        AgreedPoint point;
        point.position =
            raster.camera.back_project(u * raster.step, v * raster.step, raster.depth(u, v));
        for (int c = 0; c < 3; ++c) point.rgb[c] = raster.colours(u, v, c);
        for (std::size_t j = 0; j < rasters_.size(); ++j) {
          const Raster& other = rasters_[j];
          if (!other.camera.sees(point.position)) continue;
          const Eigen::Vector3d at = other.camera.project(point.position);
          const float there = other.depth(int(at.x()) / other.step, int(at.y()) / other.step);
          if (std::abs(there / at.z() - 1) < kAgree) point.sights.emplace_back(j, at);
        }
        if (point.sights.size() >= 2) take(point);
      }
}

}  // namespace gigaray
