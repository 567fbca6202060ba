// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "formats/origin_text.h"

// PLY, http://paulbourke.net/dataformats/ply: binary, little endian. Written here because PCL wants
// the whole cloud in memory, and because Assimp 5.2 states colours as bytes but writes floats.
namespace gigaray::ply {

static_assert(std::endian::native == std::endian::little);

/// A header up to the properties of the vertices; the number takes always as many bytes, so that it
/// can be written again. origin: see PointCloud::origin; a comment unless it is 0.
inline std::string begin_header(std::uint64_t vertices, const Eigen::Vector3d& origin,
                                std::initializer_list<const char*> float_properties) {
  constexpr std::size_t kDigits = 20;
  const std::string number = std::to_string(vertices);
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment Gigaray " +
                     std::string(kDigits - number.size(), '.') + "\n";
  if (!origin.isZero(0)) text += "comment " + origin_text(origin) + "\n";
  text += "element vertex " + number + "\n";
  for (const char* name : float_properties) text += std::string("property float ") + name + "\n";
  for (const char* name : {"red", "green", "blue"})
    text += std::string("property uchar ") + name + "\n";
  return text;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace gigaray::ply
