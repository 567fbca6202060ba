// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// poses_bounds.npy of LLFF (Mildenhall et al. 2019), https://github.com/Fyusion/LLFF: a row of 17
// numbers per picture, in the order of their names. 3 × 5 by rows: the camera's axes down, right,
// back as columns, its position, (height, width, focal length); then the nearest and the farthest
// depth that it sees.
#include <algorithm>
#include <cmath>
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/npy_matrix.h"
#include "formats/numbered_names.h"
#include "formats/readers.h"
#include "formats/stated_views.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "poses_bounds.npy";
constexpr const char* kName = "LLFF poses_bounds.npy";
constexpr int kColumns = 17;

fs::path file_of(const fs::path& input) {
  return input.filename() == kFile ? input : input / kFile;
}

/// images beside the file, else reduced copies (images_4, …), else the folder itself.
fs::path folder_beside(const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::error_code ignored;
  if (!pictures_of(folder / "images").empty()) return folder / "images";
  std::vector<fs::path> reduced;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, ignored))
    if (entry.path().filename().string().starts_with("images_") &&
        !pictures_of(entry.path()).empty())
      reduced.push_back(entry.path());
  return reduced.empty() ? folder : *std::min_element(reduced.begin(), reduced.end());
}

/// The rows are in the order of the names; where pictures are missing, numbers without another gap
/// tell which. False: nothing tells.
bool name_views(std::vector<StatedView>& views, const std::vector<fs::path>& pictures,
                bool strict) {
  if (pictures.size() == views.size()) {
    for (std::size_t i = 0; i < views.size(); ++i)
      views[i].picture = pictures[i].filename().string();
    return true;
  }
  const NameGroup group = largest_group(pictures);
  if (strict || group.pictures.size() != pictures.size() || group.changing.size() != 1)
    return false;
  const std::size_t which = *group.changing.begin();
  const std::uint64_t first = group.pictures.front().numbers[which];
  if (group.pictures.back().numbers[which] - first + 1 != views.size()) return false;
  for (std::size_t i = 0; i < views.size(); ++i) views[i].picture = "row " + std::to_string(i);
  for (const NumberedPicture& picture : group.pictures)
    views[picture.numbers[which] - first].picture = picture.path.filename().string();
  return true;
}

class LlffReader : public Reader {
 public:
  std::string name() const override { return kName; }

  /// A COLMAP model in the same folder tells more.
  ProbeResult probe(const fs::path& input) const override {
    std::error_code ignored;
    const bool is_named = input.filename() == kFile;
    return {fs::is_regular_file(file_of(input), ignored) ? (is_named ? 90 : 70) : 0, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "poses_bounds.npy states");
    const fs::path file = file_of(input);
    std::vector<StatedView> views = parse_poses_bounds(read_text(file), file.string());
    const fs::path folder = options.images.empty() ? folder_beside(file) : options.images;
    const std::vector<fs::path> pictures = pictures_of(folder);
    if (!name_views(views, pictures, options.strict))
      throw Error(ErrorCode::kBadInput,
                  file.string() + ": states " + std::to_string(views.size()) + " cameras, but " +
                      folder.string() + " holds " + std::to_string(pictures.size()) +
                      " pictures; name their folder with OpenOptions::images");
    return open_stated_views(std::move(views), file, {folder}, options, kName);
  }
};

}  // namespace

std::vector<StatedView> parse_poses_bounds(std::string_view bytes, const std::string& where) {
  const NpyMatrix rows = parse_npy_matrix(bytes, where);
  if (rows.columns != kColumns)
    throw Error(ErrorCode::kBadInput,
                where + ": has " + std::to_string(rows.columns) + " numbers per picture, not 17");
  std::vector<StatedView> views;
  for (int i = 0; i < rows.rows; ++i) {
    const std::string place = where + ", row " + std::to_string(i);
    const auto pose = [&](int row, int column) { return rows(i, 5 * row + column); };
    StatedView view;
    StatedPose matrix;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) matrix(row, column) = pose(row, column);
    set_pose(view, matrix, {"DRB", false}, place);
    const double height = pose(0, 4), width = pose(1, 4), focal = pose(2, 4);
    constexpr double kMost = 1 << 20;
    if (!(width >= 1 && width <= kMost && height >= 1 && height <= kMost))
      throw Error(ErrorCode::kBadInput, place + ": has no valid size of its picture");
    view.lens = centred_pinhole(int(std::lround(width)), int(std::lround(height)), focal);
    check(view.lens, place);
    const double nearest = rows(i, 15), farthest = rows(i, 16);
    if (nearest > 0 && nearest < farthest && std::isfinite(farthest))
      // They are percentiles of points: widened as range_of_depths widens them.
      view.inverse_depth = widened({1 / farthest, 1 / nearest});
    views.push_back(std::move(view));
  }
  return views;
}

std::unique_ptr<const Reader> llff_reader() { return std::make_unique<LlffReader>(); }

}  // namespace gigaray
