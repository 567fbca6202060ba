// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pictures/picture_files.h"

namespace gigaray {

/// Fewest pictures of a capture that must be usable.
inline constexpr std::size_t kLeastPictures = 2;

/// A picture that can't be used.
struct PictureFault {
  std::string name;  ///< as it is called in notes
  std::filesystem::path file;
  std::string why;  ///< one line that names the file
};

/// Why a picture can't be used, one line that names it: it is missing, damaged or cut short. Empty:
/// it can, and spec, if given, becomes what its header says. Throws Error(kBadInput) when it takes
/// more than `limit` bytes.
std::string fault_of_picture(const std::filesystem::path& file, Orientation orientation,
                             double limit, PictureSpec* spec = nullptr);

/// "2 of 6 pictures are left out: b.png (is missing), d.png (…)"
std::string left_out_text(const std::vector<PictureFault>& faulty, std::size_t of);

/// Masks of another size than their pictures, as a note.
std::string scaled_masks_text(int count);

}  // namespace gigaray
