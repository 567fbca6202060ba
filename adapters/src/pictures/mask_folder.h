// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gigaray/core/image.h"
#include "pictures/posed_pictures.h"

namespace gigaray {

/// Finds the masks of pictures in a folder. Lists every folder once.
class MaskFolder {
 public:
  explicit MaskFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The mask of the picture NAME, a relative path "left/a.jpg": in the same folder below, else in
  /// the folder itself; of the stem S of NAME NAME.png, S.png, mask_S.png, S_mask.png or
  /// S.mask.png, PNG or another type of picture, in any letter case. Empty when there is none.
  std::filesystem::path find(const std::string& name) const;

  /// Of all names, with a note of how many have none. Throws Error(kBadInput) when that is all.
  std::vector<std::filesystem::path> find_all(const std::vector<std::string>& names,
                                              std::vector<std::string>& notes) const;

 private:
  std::filesystem::path find_in(const std::filesystem::path& below, const std::string& name) const;

  std::filesystem::path folder_;
  /// Names without their last extension, in lower case; of several the first as names go, PNG
  /// before others.
  mutable std::map<std::filesystem::path, std::map<std::string, std::string>> listed_;
};

/// Gives pictures their masks from a folder. names: of the pictures, relative paths, in their
/// order. Throws as MaskFolder::find_all().
void attach_masks(std::vector<PosedPicture>& pictures, const std::vector<std::string>& names,
                  const std::filesystem::path& folder, std::vector<std::string>& notes);

/// Is a mask of another size than its picture? Throws Error(kBadInput) naming it when it has
/// another shape too, or can't be read.
bool is_mask_scaled(const std::filesystem::path& mask, const std::filesystem::path& picture,
                    int width, int height, Orientation orientation, double limit);

/// 1 where a mask lets the picture be looked at: where it is not black; of types that lose detail
/// (JPEG, WebP, HEIF), whose black is not exact, where it is half as bright as white or more; where
/// only its alpha channel changes, where that is half opaque. Brought to the size of the picture,
/// the nearest pixel. Throws Error(kBadInput) naming the file.
Mask read_mask(const std::filesystem::path& mask, int width, int height, Orientation orientation,
               double limit);

}  // namespace gigaray
