// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// https://colmap.github.io/format.html#depth-and-normal-maps: "width&height&channels&" as text,
// then 32-bit floats, little endian, rows from top to bottom.
#include "gigaray/adapters/colmap_maps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include "files/text.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "pictures/float_bytes.h"

namespace gigaray {
namespace fs = std::filesystem;

namespace {

/// values: channel after channel.
void write_map(const fs::path& path, int width, int height, const std::vector<float>& values) {
  std::error_code error;
  // Images in folders have maps in folders.
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error)
    throw Error(ErrorCode::kIo, path.string() + ": can't be written (" + error.message() + ")");
  const std::size_t channels = values.size() / (std::size_t(width) * height);
  std::string bytes =
      std::to_string(width) + "&" + std::to_string(height) + "&" + std::to_string(channels) + "&";
  append_floats(bytes, values.data(), values.size());
  write_file_atomically(path, bytes);
}

}  // namespace

fs::path colmap_depth_map_path(const fs::path& workspace, const std::string& name) {
  return workspace / "stereo" / "depth_maps" / (name + ".geometric.bin");
}

fs::path colmap_normal_map_path(const fs::path& workspace, const std::string& name) {
  return workspace / "stereo" / "normal_maps" / (name + ".geometric.bin");
}

void write_colmap_depth_map(const fs::path& path, const FloatMap& depth) {
  require_argument(depth.channels() == 1 && !depth.empty(),
                   "depth: a map of one channel with pixels is needed");
  std::vector<float> known(depth.begin(), depth.end());
  for (float& z : known)
    if (!std::isfinite(z)) z = 0;
  write_map(path, depth.width(), depth.height(), known);
}

void write_colmap_normal_map(const fs::path& path, const FloatMap& depth, const Camera& camera) {
  const int width = depth.width(), height = depth.height();
  require_argument(
      depth.channels() == 1 && !depth.empty() && camera.width == width && camera.height == height,
      "depth: a map of one channel, as large as the camera's picture, is needed");
  const std::size_t size = std::size_t(width) * height;
  std::vector<float> normals(3 * size, 0.f);
  const auto point = [&](int u, int v) {
    const double z = depth(u, v);
    return Eigen::Vector3d((u - camera.centre_u) / camera.focal_u * z,
                           (v - camera.centre_v) / camera.focal_v * z, z);
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3d along =
          point(std::min(u + 1, width - 1), v) - point(std::max(u - 1, 0), v);
      const Eigen::Vector3d down =
          point(u, std::min(v + 1, height - 1)) - point(u, std::max(v - 1, 0));
      Eigen::Vector3d normal = along.cross(down);
      // NaN beside a hole: no normal.
      if (!std::isfinite(depth(u, v)) || !(normal.norm() > 0)) continue;
      normal.normalize();
      if (normal.dot(point(u, v)) > 0) normal = -normal;
      for (int c = 0; c < 3; ++c) normals[c * size + std::size_t(v) * width + u] = float(normal[c]);
    }
  write_map(path, width, height, normals);
}

FloatMap read_colmap_depth_map(const fs::path& path) {
  constexpr std::uint64_t kMostHead = 100;
  const InputFile file(path);
  const std::string head = file.read(0, kMostHead);
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  std::string_view rest = head;
  const auto number = [&]() {
    constexpr int kMost = 1 << 20;  // px per axis
    const auto end = rest.find('&');
    const auto value =
        end == std::string_view::npos ? std::nullopt : parse_number(rest.substr(0, end));
    if (!value || !(*value >= 1 && *value <= kMost) || *value != int(*value))
      throw bad("is no depth map of COLMAP: it does not begin with its size");
    rest.remove_prefix(end + 1);
    return int(*value);
  };
  const int width = number(), height = number(), channels = number();
  if (channels != 1)
    throw bad("has " + std::to_string(channels) + " channels, a depth map has one");
  const std::size_t wanted = std::size_t(width) * height * sizeof(float);
  const std::uint64_t begin = head.size() - rest.size(), present = file.size() - begin;
  if (present != wanted)
    throw bad((present < wanted ? "is cut short: " : "is too long: ") + std::to_string(present) +
              " bytes of floats where its size takes " + std::to_string(wanted));
  hold_against_limit(path.string(), "has " + std::to_string(wanted) + " bytes of floats",
                     2.0 * double(wanted), opening_limit());
  FloatMap depth(width, height);
  load_floats(file.read(begin, wanted).data(), std::endian::little, depth.data(), depth.size());
  for (float& z : depth)
    if (!(z > 0) || !std::isfinite(z)) z = kNoEstimate;
  return depth;
}

}  // namespace gigaray
