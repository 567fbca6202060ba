// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/light_field.h"

namespace gigaray {

/// Has the name an extension of a picture format that light fields come in?
bool is_picture_name(const std::filesystem::path& path);

/// Regular, visible files of a folder, sorted by name. Throws Error(kBadInput) or Error(kIo).
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder);

/// Regular, visible files of a folder whose name looks like a picture. Nothing when it is no
/// folder.
std::vector<std::filesystem::path> pictures_of(const std::filesystem::path& folder);

/// Sets width, height and pixels of `light_field` from its pictures, one per view in their order,
/// and notes what is dropped. Reads headers only. Throws Error(kBadInput) naming the file: no
/// picture, damaged, another size than the others, floating-point.
void attach_pictures(LightField& light_field, std::vector<std::filesystem::path> files);

}  // namespace gigaray
