// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

namespace gigaray::glb {

/// The linear value, [0, 1], of an 8-bit sRGB one (IEC 61966-2-1), as glTF wants it in COLOR_0.
float linear(std::uint8_t srgb);

/// What the only material of a file shows.
enum class Shown { kVertexColours, kTexture };

/// The bytes of a binary glTF file with one material, which shows colours as they are
/// (KHR_materials_unlit; for who doesn't know it a rough white without metal), and for an origin
/// other than 0 with "origin": [x, y, z] in the extras of its root node: where the scene has what
/// is (0, 0, 0) in the file, in the scene's own axes.
std::string completed(std::string_view bytes, const Eigen::Vector3d& origin, Shown shown);

}  // namespace gigaray::glb
