// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// https://colmap.github.io/format.html#depth-and-normal-maps: "width&height&channels&" as text,
// then 32-bit floats, little endian, rows from top to bottom.
#include "gigaray/adapters/colmap_maps.h"

#include <cmath>
#include <system_error>

#include "float_bytes.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/error.h"
#include "text.h"

namespace gigaray {
namespace fs = std::filesystem;

fs::path colmap_depth_map_path(const fs::path& workspace, const std::string& name) {
  return workspace / "stereo" / "depth_maps" / (name + ".geometric.bin");
}

void write_colmap_depth_map(const fs::path& path, const FloatMap& depth) {
  GIGARAY_CHECK(depth.channels() == 1 && !depth.empty());
  std::error_code error;
  // Images in folders have maps in folders.
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error)
    throw Error(ErrorCode::kIo, path.string() + ": can't be written (" + error.message() + ")");
  std::string bytes = std::to_string(depth.width()) + "&" + std::to_string(depth.height()) + "&1&";
  FloatMap known = depth;
  for (float& z : known)
    if (!std::isfinite(z)) z = 0;
  append_floats(bytes, known.data(), known.size());
  write_file_atomically(path, bytes);
}

FloatMap read_colmap_depth_map(const fs::path& path) {
  const std::string bytes = read_bytes(path);
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  std::string_view rest = bytes;
  const auto number = [&]() {
    constexpr int kMost = 1 << 20;  // px per axis
    const auto end = rest.find('&');
    const auto value =
        end == std::string_view::npos ? std::nullopt : parse_number(rest.substr(0, end));
    if (!value || *value < 1 || *value > kMost || *value != int(*value))
      throw bad("is no depth map of COLMAP: it does not begin with its size");
    rest.remove_prefix(end + 1);
    return int(*value);
  };
  const int width = number(), height = number(), channels = number();
  if (channels != 1)
    throw bad("has " + std::to_string(channels) + " channels, a depth map has one");
  const std::size_t wanted = std::size_t(width) * height * sizeof(float);
  if (rest.size() != wanted)
    throw bad((rest.size() < wanted ? "is cut short: " : "is too long: ") +
              std::to_string(rest.size()) + " bytes of floats where its size takes " +
              std::to_string(wanted));
  FloatMap depth(width, height);
  load_floats(rest.data(), std::endian::little, depth.data(), depth.size());
  for (float& z : depth)
    if (!(z > 0) || !std::isfinite(z)) z = kNoEstimate;
  return depth;
}

}  // namespace gigaray
