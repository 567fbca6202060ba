// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// Where the depth map of an image lies in a dense workspace of COLMAP; what its stereo_fusion
/// reads: WORKSPACE/stereo/depth_maps/NAME.geometric.bin. name: of the image in the model.
std::filesystem::path colmap_depth_map_path(const std::filesystem::path& workspace,
                                            const std::string& name);

/// The same of a normal map.
std::filesystem::path colmap_normal_map_path(const std::filesystem::path& workspace,
                                             const std::string& name);

/// Writes depths along the optical axis as COLMAP has them, whole or not at all; creates the
/// folders. depth: scene units, NaN where there is none (0 in the file). Throws Error(kIo) when the
/// place can't be written.
void write_colmap_depth_map(const std::filesystem::path& path, const FloatMap& depth);

/// Writes the normals of a depth map in its camera, towards it, from neighbouring depths; (0, 0, 0)
/// where there is none. depth: as above, of the size of the camera's picture.
void write_colmap_normal_map(const std::filesystem::path& path, const FloatMap& depth,
                             const Camera& camera);

/// Reads such a map; 0, negative and infinite depths become NaN. Throws Error(kBadInput) naming the
/// file: no such map, cut short, more than one channel.
FloatMap read_colmap_depth_map(const std::filesystem::path& path);

}  // namespace gigaray
