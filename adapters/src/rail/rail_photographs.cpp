// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>

#include "files/text.h"
#include "formats/file_type.h"
#include "formats/numbered_names.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/rail_rectification.h"
#include "pictures/picture_files.h"
#include "pictures/picture_loading.h"
#include "pictures/picture_values.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

std::string in_words(const std::string& why) {
  return why.empty() ? " (folders inside it are not searched)" : ": " + why;
}

/// In the order of the numbers in their names, else of the names.
std::vector<fs::path> in_order(const fs::path& folder, std::vector<std::string>& notes) {
  const std::vector<fs::path> all = pictures_of(folder);
  if (all.empty()) bad(folder, "no photographs in this folder" + in_words(why_no_pictures(folder)));
  const NameGroup group = largest_group(all);
  if (!group.rival.empty())
    bad(folder, "holds more than one series of photographs, " + group.first_name() + " … and " +
                    group.rival + " …; keep one per folder");
  std::vector<fs::path> files;
  for (const NumberedPicture& picture : group.pictures) files.push_back(picture.path);
  if (files.empty()) {
    files = all;
    notes.push_back("the names of the photographs have no numbers: taken in alphabetical order");
  } else if (files.size() < all.size()) {
    notes.push_back(std::to_string(all.size() - files.size()) +
                    " other pictures in the folder are left out");
  }
  return files;
}

/// Focal length in px from the one "in 35 mm film" of the EXIF data, whose picture has a diagonal
/// of 43.27 mm.
std::optional<double> focal_of_exif(const fs::path& file, int width, int height) {
  constexpr const char* kField = "exif-ifd2-FocalLengthIn35mmFilm";
  constexpr double kDiagonalMm = 43.27;
  try {
    if (is_exr(file)) return std::nullopt;
    const vips::VImage image = open_picture(file, opening_limit());
    if (image.get_typeof(kField) == 0) return std::nullopt;
    const std::vector<std::string> words = split_words(image.get_string(kField));
    const auto mm = words.empty() ? std::nullopt : parse_number(words.front());
    if (!mm || !(*mm > 0)) return std::nullopt;  // 0: not known
    return *mm / kDiagonalMm * std::hypot(width, height);
  } catch (const vips::VError&) {
    return std::nullopt;  // read_picture_spec has the say on what is damaged
  }
}

Lens lens_of(const KnownLens& known, RailPhotographs& photographs) {
  const int width = photographs.width, height = photographs.height;
  if (known.lens) {
    Lens lens = *known.lens;
    lens.width = width;
    lens.height = height;
    try {
      check(lens, "the lens");
    } catch (const Error& error) {
      throw Error(ErrorCode::kInvalidArgument, error.what());
    }
    return lens;
  }
  photographs.distortion_is_known = false;
  if (known.focal_px) {
    const Lens lens = centred_pinhole(width, height, *known.focal_px);
    try {
      check(lens, "the focal length");
    } catch (const Error& error) {
      throw Error(ErrorCode::kInvalidArgument, error.what());
    }
    return lens;
  }
  if (const auto focal = focal_of_exif(photographs.pictures.front().file, width, height)) {
    photographs.lens_note =
        "the focal length is that of the EXIF data, " + std::to_string(std::lround(*focal)) + " px";
    return centred_pinhole(width, height, *focal);
  }
  constexpr double kUsual = 1.2;  // a camera's normal zoom, as COLMAP assumes it too
  const double focal = kUsual * std::max(width, height);
  photographs.focal_is_known = false;
  photographs.lens_note = "the focal length is not known, " + std::to_string(std::lround(focal)) +
                          " px is assumed: rows become epipolar lines all the same, the scale of "
                          "depth stays open (KnownLens::focal_px states it)";
  return centred_pinhole(width, height, focal);
}

}  // namespace

RailPhotographs open_rail_in_order(const fs::path& folder, const KnownLens& lens) {
  RailPhotographs photographs;
  const std::vector<fs::path> files = in_order(folder, photographs.notes);
  constexpr std::size_t kLeast = 3;
  if (files.size() < kLeast)
    bad(folder, "only " + std::to_string(files.size()) + " photographs; a rail needs 3 or more");
  const double limit = opening_limit();
  std::vector<PictureSpec> specs;
  for (const fs::path& file : files) {
    const PictureSpec spec = read_picture_spec(file, Orientation::kIgnored, limit);
    if (!specs.empty() &&
        (spec.width != specs.front().width || spec.height != specs.front().height))
      bad(file, "has " + size_text(spec.width, spec.height) + " pixels, " +
                    files.front().filename().string() + " has " +
                    size_text(specs.front().width, specs.front().height) +
                    "; all photographs of a rail need one size");
    specs.push_back(spec);
    photographs.pictures.push_back({file, file.stem().string(), {}, {}, {}});
  }
  photographs.width = specs.front().width;
  photographs.height = specs.front().height;
  photographs.bit_depth = common_bit_depth(specs, photographs.notes);
  photographs.scale = scale_of(files, specs, limit, photographs.notes);
  const Lens common = lens_of(lens, photographs);
  for (RailPhotograph& picture : photographs.pictures) picture.lens = common;
  return photographs;
}

}  // namespace gigaray
