// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "posed_pictures.h"

namespace gigaray {

/// Gives pictures their masks from a folder as COLMAP's --mask_path: NAME.png for the picture NAME
/// (a relative path, its extension included), or NAME with the extension .png instead of its own.
/// names: of the pictures, in their order. Pictures without a mask are noted. Throws
/// Error(kBadInput) when no picture has one.
void attach_masks(std::vector<PosedPicture>& pictures, const std::vector<std::string>& names,
                  const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace gigaray
