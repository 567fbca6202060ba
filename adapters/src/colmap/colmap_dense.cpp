// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// https://colmap.github.io/format.html#dense-reconstruction
#include "colmap/colmap_dense.h"

#include <cmath>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/colmap_maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/error.h"

namespace gigaray {

namespace fs = std::filesystem;

void ColmapDense::add(const std::string& view, const Camera& camera,
                      const Image<std::uint16_t>& picture, int bit_depth, const FloatMap& depth) {
  const std::string name = view + ".png";
  std::error_code error;
  fs::create_directories(folder_ / "images", error);
  if (error) throw Error(ErrorCode::kIo, folder_.string() + ": " + error.message());
  write_png(folder_ / "images" / name, picture, bit_depth);
  write_colmap_depth_map(colmap_depth_map_path(folder_, name), depth);
  write_colmap_normal_map(colmap_normal_map_path(folder_, name), depth, camera);

  ColmapModel::Image image;
  image.id = image.camera_id = std::uint32_t(model_.images.size() + 1);
  image.rotation = Eigen::Quaterniond(camera.rotation).normalized();
  image.translation = camera.translation;
  image.name = name;
  model_.cameras[image.camera_id] = pinhole_lens(camera);
  model_.images.push_back(std::move(image));

  points_.add(camera, picture, bit_depth, depth);
}

void ColmapDense::add_points() {
  constexpr double kCorner = 0.5;  // COLMAP's pixels have their corner at integers
  points_.visit([&](const AgreedPoint& agreed) {
    ColmapModel::Point point;
    point.id = model_.points.size() + 1;
    point.position = agreed.position;
    std::copy(agreed.rgb.begin(), agreed.rgb.end(), std::begin(point.rgb));
    for (const auto& [index, at] : agreed.sights) {
      ColmapModel::Image& image = model_.images[index];
      point.track.push_back({image.id, std::uint32_t(image.features.size())});
      image.features.push_back({at.x() + kCorner, at.y() + kCorner, point.id});
    }
    model_.points.push_back(std::move(point));
  });
}

void ColmapDense::finish() {
  add_points();
  write_colmap_model(folder_ / "sparse", model_, ColmapFormat::kBinary);
  std::string names;
  for (const ColmapModel::Image& image : model_.images) names += image.name + "\n";
  write_file_atomically(folder_ / "stereo" / "fusion.cfg", names);
}

}  // namespace gigaray
