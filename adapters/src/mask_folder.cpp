// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "mask_folder.h"

#include <system_error>

#include "gigaray/error.h"

namespace gigaray {
namespace fs = std::filesystem;

fs::path mask_of(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  const fs::path appended = folder / (name + ".png");
  if (fs::is_regular_file(appended, ignored)) return appended;
  const fs::path replaced = folder / fs::path(name).replace_extension(".png");
  return fs::is_regular_file(replaced, ignored) ? replaced : fs::path();
}

void attach_masks(std::vector<PosedPicture>& pictures, const std::vector<std::string>& names,
                  const fs::path& folder, std::vector<std::string>& notes) {
  GIGARAY_CHECK(pictures.size() == names.size() && !names.empty());
  std::size_t found = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    pictures[i].mask = mask_of(folder, names[i]);
    found += !pictures[i].mask.empty();
  }
  if (found == 0)
    throw Error(ErrorCode::kBadInput, folder.string() +
                                          ": holds no mask of any picture; the mask of " +
                                          names.front() + " is " + names.front() + ".png");
  if (found < pictures.size())
    notes.push_back(std::to_string(pictures.size() - found) + " of " +
                    std::to_string(pictures.size()) + " pictures have no mask in " +
                    folder.string() + " and are used as they are");
}

}  // namespace gigaray
