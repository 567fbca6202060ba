// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/run_control.h"
#include "picture_files.h"

namespace gigaray {

/// Photographs as COLMAP gets them: its own library reads 8-bit pictures of the usual formats
/// alone, and a program that ends with a signal for some others.
class ColmapPictures {
 public:
  /// photographs: names in `folder`. copies: a folder that is made when one of them has to be
  /// copied: all are in it then, links and 8-bit JPEGs with the EXIF of the photograph, under their
  /// own names. Throws Error(kBadInput) for a picture that can't be read, Error(kIo) when a copy
  /// can't be written.
  ColmapPictures(const std::filesystem::path& folder, const std::vector<std::string>& names,
                 const std::filesystem::path& copies, const RunControl& control);
  /// Removes the copies.
  ~ColmapPictures();
  ColmapPictures(const ColmapPictures&) = delete;
  ColmapPictures& operator=(const ColmapPictures&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<PictureSpec>& specs() const { return specs_; }
  int num_copies() const { return num_copies_; }

 private:
  std::filesystem::path folder_, copies_;
  std::vector<PictureSpec> specs_;
  int num_copies_ = 0;
};

}  // namespace gigaray
