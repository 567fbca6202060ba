// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "colmap/colmap_folders.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// "0", "1", … "10".
bool by_number(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename().string(), y = b.filename().string();
  return x.size() != y.size() ? x.size() < y.size() : x < y;
}

bool is_part_of_model(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "cameras.bin", ignored) || fs::exists(folder / "cameras.txt", ignored);
}

}  // namespace

std::vector<fs::path> colmap_models_of(const fs::path& input) {
  if (is_colmap_model(input)) return {input};
  for (const fs::path& folder : {input / "sparse", input / "dense" / "sparse",
                                 input / "colmap" / "sparse", input / "distorted" / "sparse"}) {
    if (is_colmap_model(folder)) return {folder};
    std::vector<fs::path> models = colmap_models_below(folder);
    if (!models.empty()) return models;
  }
  std::vector<fs::path> models = colmap_models_below(input);  // INPUT is the folder "sparse"
  if (!models.empty()) return models;
  for (const fs::path& folder : {input, input / "sparse", input / "sparse" / "0"})
    if (is_part_of_model(folder)) return {folder};
  return {};
}

std::vector<fs::path> colmap_models_below(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> models;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_colmap_model(entry->path())) models.push_back(entry->path());
  std::sort(models.begin(), models.end(), by_number);
  return models;
}

FoundColmapModel largest_colmap_model(const std::vector<fs::path>& folders,
                                      std::vector<std::string>& notes, bool strict) {
  GIGARAY_CHECK(!folders.empty());
  if (folders.size() == 1) return {folders[0], read_colmap_model(folders[0], strict)};
  FoundColmapModel best;
  std::string sizes;
  std::optional<Error> problem;
  for (const fs::path& folder : folders) {
    try {
      ColmapModel model = read_colmap_model(folder, strict);
      sizes += (sizes.empty() ? "" : ", ") + folder.filename().string() + " has " +
               std::to_string(model.images.size());
      if (model.images.size() > best.model.images.size()) best = {folder, std::move(model)};
    } catch (const Error& error) {
      problem = error;
      notes.push_back(std::string("left out: ") + error.what());
    }
  }
  if (best.model.images.empty()) throw *problem;
  notes.push_back(std::to_string(folders.size()) + " models (" + sizes +
                  " images): the largest is taken; give the folder of another one as INPUT");
  return best;
}

}  // namespace gigaray
