// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/picture_faults.h"

#include <limits>
#include <system_error>

#include "gigaray/core/error.h"

namespace gigaray {

namespace fs = std::filesystem;

std::string fault_of_picture(const fs::path& file, Orientation orientation, double limit,
                             PictureSpec* spec) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return file.string() + ": is missing";
  try {
    const PictureSpec stated = read_picture_spec(file, orientation, limit);
    if (spec) *spec = stated;
  } catch (const Error& problem) {
    // What is too large for the limit alone is no fault of the picture.
    try {
      read_picture_spec(file, orientation, std::numeric_limits<double>::infinity());
    } catch (const Error&) {
      return problem.what();
    }
    throw;
  }
  if (!may_be_cut_short(file)) return {};
  try {
    PictureSpec ignored_spec;
    decode_picture(file, orientation, ignored_spec, limit);
  } catch (const Error& problem) {
    return problem.what();
  }
  return {};
}

std::string left_out_text(const std::vector<PictureFault>& faulty, std::size_t of) {
  constexpr std::size_t kMostNamed = 5;
  std::string text = std::to_string(faulty.size()) + " of " + std::to_string(of) +
                     (faulty.size() == 1 ? " pictures is left out: " : " pictures are left out: ");
  for (std::size_t i = 0; i < std::min(faulty.size(), kMostNamed); ++i) {
    const std::string path = faulty[i].file.string() + ": ";
    const std::string& why = faulty[i].why;
    text += (i > 0 ? ", " : "") + faulty[i].name + " (" +
            (why.starts_with(path) ? why.substr(path.size()) : why) + ")";
  }
  if (faulty.size() > kMostNamed)
    text += " and " + std::to_string(faulty.size() - kMostNamed) + " more";
  return text;
}

std::string scaled_masks_text(int count) {
  return std::to_string(count) + (count == 1 ? " mask has" : " masks have") +
         " another size than the picture: scaled";
}

}  // namespace gigaray
