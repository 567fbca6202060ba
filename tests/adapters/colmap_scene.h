// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "gigaray/adapters/colmap_model.h"

namespace gigaray {

/// Cameras along a line that look ahead, turned a little, and points before them at depths of 4 to
/// 8, each seen by all of them. Images "v0.png" … of 23 x 17 px.
inline ColmapModel colmap_scene(int num_images = 3, int num_points = 40) {
  ColmapModel model;
  model.cameras[7] = {"PINHOLE", 23, 17, {30, 31, 11.5, 8.5}};
  for (int i = 0; i < num_images; ++i) {
    ColmapModel::Image image;
    image.id = std::uint32_t(10 + 3 * i);
    image.rotation = Eigen::AngleAxisd(0.02 * i, Eigen::Vector3d(0.2, 1, 0.1).normalized());
    image.translation = image.rotation * Eigen::Vector3d(-0.3 * i, 0, 0);
    image.camera_id = 7;
    image.name = "v" + std::to_string(i) + ".png";
    model.images.push_back(std::move(image));
  }
  for (int k = 0; k < num_points; ++k) {
    ColmapModel::Point point;
    point.id = std::uint64_t(100 + 2 * k);
    point.position = {0.1 + 0.4 * std::sin(k), 0.3 * std::cos(2 * k), 4 + 4.0 * k / num_points};
    point.rgb = {std::uint8_t(k), 128, 255};
    point.error = 0.5 + 0.01 * k;
    for (ColmapModel::Image& image : model.images) {
      const Eigen::Vector3d at = image.rotation * point.position + image.translation;
      point.track.push_back({image.id, std::uint32_t(image.features.size())});
      image.features.push_back({30 * at.x() / at.z() + 11.5, 31 * at.y() / at.z() + 8.5, point.id});
    }
    model.points.push_back(std::move(point));
  }
  model.images.front().features.push_back({1.25, 2.5, ColmapModel::kNoPoint});
  return model;
}

}  // namespace gigaray
