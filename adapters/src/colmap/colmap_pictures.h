// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/core/run_control.h"
#include "pictures/picture_files.h"

namespace gigaray {

/// Photographs and their masks as COLMAP gets them: its own library reads 8-bit pictures of the
/// usual formats alone, and a program that ends with a signal for some others.
class ColmapPictures {
 public:
  /// Looks at the photographs of a folder. Those that can't be read are left out and named through
  /// `control`. work: where copies will be. Throws Error(kBadInput) when fewer than two are left,
  /// when `strict` for any.
  ColmapPictures(const std::filesystem::path& photographs, const std::filesystem::path& work,
                 bool strict, const RunControl& control);
  /// Removes the copies of photographs.
  ~ColmapPictures();
  ColmapPictures(const ColmapPictures&) = delete;
  ColmapPictures& operator=(const ColmapPictures&) = delete;

  /// When one photograph has to be copied, makes a folder with all of them under their own names:
  /// links and 8-bit JPEGs with the EXIF of the photograph. masks: see OpenOptions; becomes a
  /// folder of PNGs of the names and sizes that COLMAP looks for. Throws Error(kBadInput) for what
  /// can't be decoded and for masks of which none fits, Error(kIo) when a copy can't be written.
  void write_copies(const std::filesystem::path& masks, const RunControl& control);

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<PictureSpec>& specs() const { return specs_; }
  /// Of the photographs, or their copies.
  const std::filesystem::path& folder() const { return folder_; }
  const std::filesystem::path& masks() const { return masks_; }  ///< empty: none

 private:
  void copy_photographs(const std::vector<bool>& is_copied, const RunControl& control);
  void write_masks(const std::filesystem::path& from);

  std::filesystem::path photographs_, work_, folder_, masks_;
  std::vector<std::string> names_;
  std::vector<PictureSpec> specs_;
  double limit_;
};

}  // namespace gigaray
