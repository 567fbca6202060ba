// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "posed_pictures.h"

namespace gigaray {

/// The mask of the picture NAME in a folder: NAME.png (its extension included), or NAME with the
/// extension .png instead of its own. Empty when there is none.
std::filesystem::path mask_of(const std::filesystem::path& folder, const std::string& name);

/// Gives pictures their masks from a folder. names: of the pictures, relative paths, in their
/// order. Pictures without a mask are noted. Throws Error(kBadInput) when no picture has one.
void attach_masks(std::vector<PosedPicture>& pictures, const std::vector<std::string>& names,
                  const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace gigaray
