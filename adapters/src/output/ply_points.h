// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace gigaray {

/// x, y and z of the vertices of a PLY file: text or binary of both byte orders, other properties
/// passed over; the vertices are its first element. Those that are not finite are left out. Read
/// here because Assimp 5.2 never ends with a header that is cut short, and takes vertices that a
/// file lacks for zeros. Throws Error(kBadInput) beginning with `where`.
std::vector<Eigen::Vector3d> parse_ply_points(std::string_view bytes, const std::string& where);

}  // namespace gigaray
