// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// transforms.json, https://docs.nerf.studio/quickstart/data_conventions.html; see
// transforms_json_reader.cpp for its axes.
#include "formats/nerfstudio_scene.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "output/ply.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kMost = 65535;

Image<std::uint16_t> as_8_bit(const Image<std::uint16_t>& picture, int bit_depth) {
  Image<std::uint16_t> result = picture;
  for (std::uint16_t& value : result) value = std::uint16_t(value >> (bit_depth - 8));
  return result;
}

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ErrorCode::kIo, folder.string() + ": " + error.message());
}

/// What one step of a depth map is worth: nerfstudio's 0.001 where it holds nearly all, and tells
/// them apart; else another power of ten.
double unit_for(std::vector<float> depths) {
  constexpr double kUsual = 1e-3, kNearlyAll = 0.995, kFinest = 500;
  if (depths.empty()) return kUsual;
  const auto quantile = [&](double at) {
    const auto place = depths.begin() + std::lround(at * double(depths.size() - 1));
    std::nth_element(depths.begin(), place, depths.end());
    return double(*place);
  };
  if (quantile(kNearlyAll) <= kMost * kUsual && quantile(0.5) >= kFinest * kUsual) return kUsual;
  return std::pow(10, std::ceil(std::log10(quantile(kNearlyAll) / kMost)));
}

ordered_json intrinsics_of(const Camera& camera) {
  constexpr double kCorner = 0.5;  // pixels have their corner at integers
  return {{"w", camera.width},
          {"h", camera.height},
          {"fl_x", camera.focal_u},
          {"fl_y", camera.focal_v},
          {"cx", camera.centre_u + kCorner},
          {"cy", camera.centre_v + kCorner}};
}

/// Camera → scene, axes right, up, back.
ordered_json pose_of(const Camera& camera) {
  Eigen::Matrix3d axes = camera.rotation.transpose();
  axes.rightCols<2>() *= -1;
  const Eigen::Vector3d position = camera.position();
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back({axes(row, 0), axes(row, 1), axes(row, 2), position[row]});
  rows.push_back({0, 0, 0, 1});
  return rows;
}

}  // namespace

void NerfstudioScene::add(const std::string& view, const Camera& camera,
                          const Image<std::uint16_t>& picture, int bit_depth, const FloatMap& depth,
                          fs::path depth_file) {
  create_folder(folder_ / "images");
  write_png(folder_ / "images" / (view + ".png"), as_8_bit(picture, bit_depth), 8);
  points_.add(camera, picture, bit_depth, depth);
  frames_.push_back({view, camera, std::move(depth_file)});
  constexpr std::size_t kSome = 97;
  for (std::size_t i = 0; i < depth.size(); i += kSome)
    if (std::isfinite(depth.data()[i])) depths_.push_back(depth.data()[i]);
}

void NerfstudioScene::write_depth_maps(double unit) const {
  create_folder(folder_ / "depths");
  for (const Frame& frame : frames_) {
    const FloatMap depth = read_pfm(frame.depth_file);
    Image<std::uint16_t> steps(depth.width(), depth.height());
    std::transform(depth.begin(), depth.end(), steps.begin(), [&](float z) {
      const double value = std::round(z / unit);
      return std::uint16_t(value >= 1 && value <= kMost ? value : 0);  // NaN fails both
    });
    write_png(folder_ / "depths" / (frame.view + ".png"), steps, 16);
  }
}

void NerfstudioScene::write_transforms(double unit) const {
  ordered_json root{{"camera_model", "PINHOLE"}};
  const ordered_json first = intrinsics_of(frames_.front().camera);
  const bool shared = std::ranges::all_of(
      frames_, [&](const Frame& frame) { return intrinsics_of(frame.camera) == first; });
  if (shared) root.update(first);
  root["depth_unit_scale_factor"] = unit;
  root["ply_file_path"] = "points.ply";
  root["frames"] = ordered_json::array();
  for (const Frame& frame : frames_) {
    ordered_json entry{{"file_path", "images/" + frame.view + ".png"},
                       {"depth_file_path", "depths/" + frame.view + ".png"}};
    if (!shared) entry.update(intrinsics_of(frame.camera));
    entry["transform_matrix"] = pose_of(frame.camera);
    root["frames"].push_back(std::move(entry));
  }
  write_file_atomically(folder_ / "transforms.json", root.dump(2) + "\n");
}

void NerfstudioScene::write_points() const {
  std::string bytes;
  std::uint64_t count = 0;
  points_.visit([&](const AgreedPoint& point) {
    for (const double number : point.position) ply::append(bytes, float(number));
    ply::append(bytes, point.rgb);
    ++count;
  });
  write_file_atomically(
      folder_ / "points.ply",
      ply::begin_header(count, Eigen::Vector3d::Zero(), {"x", "y", "z"}) + "end_header\n" + bytes);
}

void NerfstudioScene::finish() {
  const double unit = unit_for(depths_);
  write_depth_maps(unit);
  write_transforms(unit);
  write_points();
}

}  // namespace gigaray
