// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>

#include "gigaray/core/light_field.h"

namespace gigaray {

/// A file of points of the scene in a folder of cameras: `stated` (relative; may be empty), else
/// one with a usual name, such as sparse_pc.ply or points3D.ply. Empty: there is none.
std::filesystem::path points_beside(const std::filesystem::path& folder,
                                    const std::string& stated = "");

/// Gives the cameras of an unstructured light field that have no range of inverse depths that of
/// the points of a PLY file which they see, with a note; none, with another note, when most see
/// too few, and when the file is damaged or larger than memory_bytes allow.
void take_range_of_points(LightField& light_field, const std::filesystem::path& file,
                          double memory_bytes);

}  // namespace gigaray
