// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "formats/origin_text.h"
#include "gigaray/core/point_cloud.h"

// PCD 0.7, https://pointclouds.org/documentation/tutorials/pcd_file_format.html, binary. Written
// here because PCL's writer wants the whole cloud in memory.
namespace gigaray::pcd {

static_assert(std::endian::native == std::endian::little);

/// The number takes always as many bytes, so that it can be written again. origin: a comment unless
/// it is 0.
inline std::string header(std::uint64_t points, const Eigen::Vector3d& origin) {
  constexpr std::size_t kDigits = 20;
  const std::string number = std::to_string(points);
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\n# Gigaray " +
                     std::string(2 * (kDigits - number.size()), '.') + "\n";
  if (!origin.isZero(0)) text += "# " + origin_text(origin) + "\n";
  return text +
         "VERSION 0.7\n"
         "FIELDS x y z normal_x normal_y normal_z confidence support rgb\n"
         "SIZE 4 4 4 4 4 4 4 4 4\nTYPE F F F F F F F F F\nCOUNT 1 1 1 1 1 1 1 1 1\nWIDTH " +
         number + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number + "\nDATA binary\n";
}

/// Colours as PCL packs them: the bits of a float are 0x00rrggbb.
inline float packed(const Rgb8& colour) {
  const std::uint32_t bits =
      std::uint32_t(colour[0]) << 16 | std::uint32_t(colour[1]) << 8 | std::uint32_t(colour[2]);
  return std::bit_cast<float>(bits);
}

}  // namespace gigaray::pcd
