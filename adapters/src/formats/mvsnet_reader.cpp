// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// cams/NAME_cam.txt of MVSNet (Yao et al. 2018), https://github.com/YoYo000/MVSNet#file-formats, as
// DTU, Tanks and Temples and BlendedMVS are given out for it: the word "extrinsic" and 4 × 4
// numbers scene → camera, the word "intrinsic" and K by rows with pixel corners at integers, then
// the nearest depth, the step between depths and perhaps their number and the farthest depth.
#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "formats/stated_views.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"
#include "pictures/picture_lookup.h"
#include "pictures/projection.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "MVSNet cameras";
constexpr const char* kEnding = "_cam.txt";

/// Of a scene's folder those in cams/, or of the folder itself.
std::vector<fs::path> camera_files_of(const fs::path& input) {
  for (const char* below : {"cams", "cams_1", "Cameras", "cameras", "cam", "."})
    if (auto files = files_ending_in(kEnding, input / below); !files.empty()) return files;
  return {};
}

std::string stem_of(const fs::path& camera_file) {
  const std::string name = camera_file.filename().string();
  return name.substr(0, name.size() - std::string_view(kEnding).size());
}

/// Where the pictures of the files of cameras may lie.
std::vector<fs::path> picture_folders(const fs::path& cameras) {
  const fs::path scene = fs::absolute(cameras / "x").lexically_normal().parent_path().parent_path();
  std::vector<fs::path> folders;
  for (const fs::path& place : {scene, fs::absolute(cameras)})
    for (const char* below : {"images", "blended_images", "image", "Images", "Rectified", "."})
      folders.push_back((place / below).lexically_normal());
  return folders;
}

class MvsnetReader : public Reader {
 public:
  std::string name() const override { return kName; }

  ProbeResult probe(const fs::path& input) const override {
    return {camera_files_of(input).empty() ? 0 : 75, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "the files of cameras state");
    const std::vector<fs::path> files = camera_files_of(input);
    std::vector<StatedView> views;
    for (const fs::path& file : files) {
      views.push_back(view_of_file(parse_mvsnet_camera, file));
      views.back().picture = stem_of(file);
    }
    const fs::path folder = files.front().parent_path();
    LightField light_field =
        open_stated_views(std::move(views), folder, picture_folders(folder), options, kName);
    const InverseDepthRange range = all_inverse_depths(light_field.cameras);
    light_field.notes.push_back("depths from " + short_text(1 / range.max) + " to " +
                                short_text(1 / range.min) + " as the files of cameras state them" +
                                " (DepthOptions::disparity states inverse depths)");
    return light_field;
  }

 private:
  static std::string short_text(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", number);
    return text;
  }
};

/// Nearest and farthest depth of the numbers at the end of a file.
InverseDepthRange range_of(const std::vector<double>& numbers, const std::string& where) {
  constexpr double kUsualPlanes = 192;  // MVSNet's own number, when none is stated
  const double nearest = numbers[0], step = numbers[1];
  const double planes = numbers.size() > 2 ? numbers[2] : kUsualPlanes;
  const double farthest = numbers.size() > 3 ? numbers[3] : nearest + step * (planes - 1);
  if (!(nearest > 0 && farthest > nearest))
    throw Error(ErrorCode::kBadInput, where + ": states depths from " + std::to_string(nearest) +
                                          " to " + std::to_string(farthest) +
                                          ", which is no range before the camera");
  return {1 / farthest, 1 / nearest};
}

}  // namespace

StatedView parse_mvsnet_camera(std::string_view text, const std::string& where) {
  constexpr std::size_t kExtrinsic = 16, kIntrinsic = 9, kLeast = 2, kMost = 4;
  const auto bad = [&](const std::string& what) {
    throw Error(ErrorCode::kBadInput, where + ": " + what);
  };
  const std::vector<std::string> words = split_words(text);
  const auto has_word = [&](std::size_t place, const char* word) {
    return place < words.size() && lower(words[place]).starts_with(word);
  };
  if (!has_word(0, "extrinsic")) bad("does not begin with \"extrinsic\"");
  if (!has_word(1 + kExtrinsic, "intrinsic"))
    bad("does not have \"intrinsic\" behind 16 numbers; it is cut short or of another kind");
  const std::size_t depths_at = 2 + kExtrinsic + kIntrinsic;
  if (words.size() < depths_at + kLeast || words.size() > depths_at + kMost)
    bad("has " + std::to_string(words.size()) + " words; two words, 16 and 9 numbers and 2 to 4 " +
        "of depths are expected");
  using Words = std::vector<std::string>;
  const auto numbers_at = [&](std::size_t first, std::size_t count, PoseAt pose = {}) {
    const auto begin = words.begin() + std::ptrdiff_t(first);
    return finite_numbers(Words(begin, begin + std::ptrdiff_t(count)), 0, where, pose);
  };
  const std::vector<double> pose = numbers_at(1, kExtrinsic, {0, kExtrinsic});
  const std::vector<double> k = numbers_at(2 + kExtrinsic, kIntrinsic);
  StatedView view;
  set_projection(view, k.data(), where);
  view.lens.params = {k[0], k[4], k[2], k[5]};
  view.may_be_of_a_copy = true;  // DTU has K for maps of a quarter of the size
  set_pose(view, Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(pose.data()),
           {"RDF", true}, where);
  view.inverse_depth = range_of(numbers_at(depths_at, words.size() - depths_at), where);
  return view;
}

std::unique_ptr<const Reader> mvsnet_reader() { return std::make_unique<MvsnetReader>(); }

}  // namespace gigaray
