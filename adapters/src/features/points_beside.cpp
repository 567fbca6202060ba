// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "features/points_beside.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include "files/text.h"
#include "gigaray/adapters/input_file.h"
#include "output/ply_points.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr std::array kNames{"sparse_pc.ply", "points3d.ply", "point_cloud.ply",  "pointcloud.ply",
                            "points.ply",    "sparse.ply",   "sparse_points.ply"};

}  // namespace

fs::path points_beside(const fs::path& folder, const std::string& stated) {
  std::error_code ignored;
  if (!stated.empty() && fs::is_regular_file(folder / stated, ignored)) return folder / stated;
  if (!fs::is_directory(folder, ignored)) return {};
  const std::vector<fs::path> files = files_of(folder);
  for (const char* name : kNames)
    for (const fs::path& path : files)
      if (lower(path.filename().string()) == name) return path;
  return {};
}

void take_range_of_points(LightField& light_field, const fs::path& file, double memory_bytes) {
  std::vector<Camera>& cameras = light_field.cameras;
  if (std::ranges::all_of(cameras, [](const Camera& c) { return c.inverse_depth.has_value(); }))
    return;
  std::vector<Eigen::Vector3d> points;
  try {
    constexpr double kBytesPerByte = 9;  // itself, and a point for three of the least
    points = parse_ply_points(read_bytes(file, opening_limit(memory_bytes) / kBytesPerByte),
                              file.string());
  } catch (const Error& problem) {
    // The range can be estimated without them.
    light_field.notes.push_back(std::string(problem.what()) + "; it is not used");
    return;
  }
  if (light_field.pose_reading && light_field.pose_reading->is_mirrored)
    for (Eigen::Vector3d& point : points) point.z() *= -1;
  std::vector<std::optional<InverseDepthRange>> ranges;
  for (const Camera& camera : cameras) {
    std::vector<double> depths;
    for (const Eigen::Vector3d& point : points)
      if (camera.sees(point)) depths.push_back(camera.project(point).z());
    ranges.push_back(range_of_depths(std::move(depths)));
  }
  const auto num_seeing =
      std::ranges::count_if(ranges, [](const auto& range) { return range.has_value(); });
  const std::string which =
      "the " + std::to_string(points.size()) + " points of " + file.filename().string();
  if (2 * std::size_t(num_seeing) < cameras.size()) {
    light_field.notes.push_back(which + " are not where the cameras look: they are not used");
    return;
  }
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (!cameras[i].inverse_depth) cameras[i].inverse_depth = ranges[i];
  light_field.notes.push_back("depths are searched where " + which + " are");
}

}  // namespace gigaray
