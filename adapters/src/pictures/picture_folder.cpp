// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/picture_folder.h"

#include <algorithm>
#include <system_error>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_in(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  return fs::is_regular_file(folder / name, ignored);
}

}  // namespace

fs::path folder_of_pictures(const fs::path& model, const std::vector<fs::path>& folders,
                            const std::vector<std::string>& names, std::size_t least) {
  GIGARAY_CHECK(!folders.empty() && !names.empty());
  fs::path best = folders.front();
  std::size_t most = 0;
  for (const fs::path& folder : folders) {
    const auto count = std::size_t(std::count_if(
        names.begin(), names.end(), [&](const std::string& name) { return is_in(folder, name); }));
    if (count > most) {
      most = count;
      best = folder;
    }
  }
  if (most == names.size() || (most > 0 && most >= least)) return best;
  const std::string all = std::to_string(names.size());
  if (most == 0)
    throw Error(ErrorCode::kBadInput, model.string() + ": none of the " + all +
                                          " pictures that it names was found in " + best.string() +
                                          " (the first is " + names.front() +
                                          "); name their folder with OpenOptions::images");
  const auto missing = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return !is_in(best, name); });
  throw Error(ErrorCode::kBadInput,
              (best / *missing).string() + ": is missing, one of " +
                  std::to_string(names.size() - most) + " of the " + all + " pictures that " +
                  model.string() +
                  " names; put them there or name their folder with OpenOptions::images");
}

}  // namespace gigaray
