// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/mask_folder.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "files/text.h"
#include "formats/file_type.h"
#include "gigaray/core/error.h"
#include "pictures/picture_alpha.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

bool are_all_equal(const Image<std::uint16_t>& picture) {
  return std::all_of(picture.begin(), picture.end(),
                     [&](std::uint16_t value) { return value == picture.data()[0]; });
}

}  // namespace

fs::path MaskFolder::find_in(const fs::path& below, const std::string& name) const {
  const auto [entry, is_new] = listed_.try_emplace(below);
  auto& masks = entry->second;
  std::error_code error;
  if (is_new && fs::is_directory(folder_ / below, error))
    for (const fs::path& path : files_of(folder_ / below)) {
      if (!is_picture_name(path)) continue;
      const std::string file = path.filename().string();
      const auto [known, is_first] = masks.emplace(lower(path.stem().string()), file);
      if (!is_first && lower(file).ends_with(".png")) known->second = file;
    }
  const std::string whole = lower(name), stem = lower(fs::path(name).stem().string());
  for (const std::string& wanted : {whole, stem, "mask_" + stem, stem + "_mask", stem + ".mask",
                                    "mask_" + whole, stem + "-mask"})
    if (const auto found = masks.find(wanted); found != masks.end())
      return folder_ / below / found->second;
  return {};
}

fs::path MaskFolder::find(const std::string& name) const {
  const fs::path path = fs::path(name).lexically_normal();
  const std::string file = path.filename().string();
  if (path.is_relative() && path.has_parent_path())
    if (fs::path mask = find_in(path.parent_path(), file); !mask.empty()) return mask;
  return find_in({}, file);
}

std::vector<fs::path> MaskFolder::find_all(const std::vector<std::string>& names,
                                           std::vector<std::string>& notes) const {
  GIGARAY_CHECK(!names.empty());
  std::error_code ignored;
  if (!fs::is_directory(folder_, ignored)) bad(folder_, "is no folder of masks");
  std::vector<fs::path> masks;
  for (const std::string& name : names) masks.push_back(find(name));
  const auto missing =
      std::ranges::count_if(masks, [](const fs::path& mask) { return mask.empty(); });
  if (missing == std::ptrdiff_t(names.size()))
    bad(folder_, "holds no mask of any picture; the mask of " + names.front() + " is " +
                     names.front() + ".png");
  if (missing > 0)
    notes.push_back(std::to_string(missing) + " of " + std::to_string(names.size()) +
                    " pictures have no mask in " + folder_.string() + " and are used as they are");
  return masks;
}

void attach_masks(std::vector<PosedPicture>& pictures, const std::vector<std::string>& names,
                  const fs::path& folder, std::vector<std::string>& notes) {
  GIGARAY_CHECK(pictures.size() == names.size());
  const std::vector<fs::path> masks = MaskFolder(folder).find_all(names, notes);
  for (std::size_t i = 0; i < pictures.size(); ++i) pictures[i].mask = masks[i];
}

bool is_mask_scaled(const fs::path& mask, const fs::path& picture, int width, int height,
                    Orientation orientation, double limit) {
  const PictureSpec spec = read_picture_spec(mask, orientation, limit);
  if (spec.width == width && spec.height == height) return false;
  // Rounded to whole pixels, of the smaller one.
  const double of_width = double(spec.width) / width, of_height = double(spec.height) / height;
  const double rounding = 0.5 / std::min(width, spec.width) + 0.5 / std::min(height, spec.height);
  if (std::abs(of_width / of_height - 1) > rounding)
    bad(mask, "has " + size_text(spec.width, spec.height) + " pixels, its picture " +
                  picture.filename().string() + " has " + size_text(width, height) +
                  "; a mask needs the same size, or the same shape");
  return true;
}

Mask read_mask(const fs::path& path, int width, int height, Orientation orientation, double limit) {
  PictureSpec spec;
  const Image<std::uint16_t> mask = decode_picture(path, orientation, spec, limit);
  const int least = !is_lossy(path) ? 1 : spec.bit_depth == 8 ? 128 : 32768;
  Mask alpha;
  if (spec.has_alpha && !spec.is_turned && are_all_equal(mask)) alpha = read_alpha(path, limit, {});
  Mask seen(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      // The pixel that the centre of this one lies in.
      const int x = int((u + 0.5) * mask.width() / width);
      const int y = int((v + 0.5) * mask.height() / height);
      seen(u, v) = !alpha.empty() ? alpha(x, y)
                                  : std::uint8_t(mask(x, y, 0) >= least || mask(x, y, 1) >= least ||
                                                 mask(x, y, 2) >= least);
    }
  return seen;
}

}  // namespace gigaray
