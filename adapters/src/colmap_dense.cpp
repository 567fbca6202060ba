// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// https://colmap.github.io/format.html#dense-reconstruction
#include "colmap_dense.h"

#include <cmath>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/colmap_maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/error.h"

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

  constexpr double kMostPoints = 2000;
  Raster raster;
  raster.camera = camera;
  raster.step = int(std::ceil(std::sqrt(double(camera.width) * camera.height / kMostPoints)));
  raster.depth =
      FloatMap(1 + (camera.width - 1) / raster.step, 1 + (camera.height - 1) / raster.step);
  raster.colours = Image<std::uint16_t>(raster.depth.width(), raster.depth.height(), 3);
  for (int v = 0; v < raster.depth.height(); ++v)
    for (int u = 0; u < raster.depth.width(); ++u) {
      raster.depth(u, v) = depth(u * raster.step, v * raster.step);
      for (int c = 0; c < 3; ++c)
        raster.colours(u, v, c) = picture(u * raster.step, v * raster.step, c);
    }
  rasters_.push_back(std::move(raster));
  bit_depth_ = bit_depth;
}

void ColmapDense::add_points() {
  constexpr double kAgree = 0.02;  // of the depth
  constexpr double kCorner = 0.5;  // COLMAP's pixels have their corner at integers
  for (std::size_t i = 0; i < rasters_.size(); ++i) {
    const Raster& raster = rasters_[i];
    for (int v = 0; v < raster.depth.height(); ++v)
      for (int u = 0; u < raster.depth.width(); ++u) {
        if (std::isnan(raster.depth(u, v))) continue;
        ColmapModel::Point point;
        point.id = model_.points.size() + 1;
        point.position =
            raster.camera.back_project(u * raster.step, v * raster.step, raster.depth(u, v));
        for (int c = 0; c < 3; ++c)
          point.rgb[c] = std::uint8_t(raster.colours(u, v, c) >> (bit_depth_ - 8));
        std::vector<std::pair<std::size_t, Eigen::Vector3d>> sights;
        for (std::size_t j = 0; j < rasters_.size(); ++j) {
          const Raster& other = rasters_[j];
          if (!other.camera.sees(point.position)) continue;
          const Eigen::Vector3d at = other.camera.project(point.position);
          const float there = other.depth(int(at.x()) / other.step, int(at.y()) / other.step);
          if (std::abs(there / at.z() - 1) < kAgree) sights.emplace_back(j, at);
        }
        if (sights.size() < 2) continue;
        for (const auto& [j, at] : sights) {
          ColmapModel::Image& image = model_.images[j];
          point.track.push_back({image.id, std::uint32_t(image.features.size())});
          image.features.push_back({at.x() + kCorner, at.y() + kCorner, point.id});
        }
        model_.points.push_back(std::move(point));
      }
  }
}

void ColmapDense::finish() {
  add_points();
  write_colmap_model(folder_ / "sparse", model_, ColmapFormat::kBinary);
  std::string names;
  for (const ColmapModel::Image& image : model_.images) names += image.name + "\n";
  write_file_atomically(folder_ / "stereo" / "fusion.cfg", names);
}

}  // namespace gigaray
