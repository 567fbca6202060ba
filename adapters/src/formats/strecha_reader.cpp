// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// PICTURE.camera of Strecha et al. 2008: K by rows, a line for distortion, the camera's rotation
// camera → scene by rows, its position, width and height. A scene point X is seen at
// K Rᵀ (X - position), pixel centres at integers.
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "formats/stated_views.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"
#include "pictures/projection.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "Strecha .camera files";
constexpr const char* kExtension = ".camera";

class StrechaReader : public Reader {
 public:
  std::string name() const override { return kName; }

  ProbeResult probe(const fs::path& input) const override {
    return {files_ending_in(kExtension, input).empty() ? 0 : 75, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "the .camera files state");
    std::vector<StatedView> views;
    for (const fs::path& file : files_ending_in(kExtension, input)) {
      views.push_back(view_of_file(parse_strecha_camera, file));
      views.back().picture = file.stem().string();
    }
    const fs::path above = fs::absolute(input / "x").lexically_normal().parent_path().parent_path();
    return open_stated_views(std::move(views), input,
                             {input, input / "images", above / "images", above}, options, kName);
  }
};

}  // namespace

StatedView parse_strecha_camera(std::string_view text, const std::string& where) {
  constexpr std::size_t kWithoutDistortion = 23, kWithDistortion = 26, kPoseAndSize = 14;
  const std::vector<std::string> words = split_words(text);
  if (words.size() != kWithoutDistortion && words.size() != kWithDistortion)
    throw Error(ErrorCode::kBadInput, where + ": holds " + std::to_string(words.size()) +
                                          " numbers; K, distortion, R, position and size are 26");
  const std::vector<double> numbers =
      finite_numbers(words, 0, where, {words.size() - kPoseAndSize, words.size() - 2});
  StatedView view;
  const double* next = numbers.data();
  const double width = numbers[numbers.size() - 2], height = numbers[numbers.size() - 1];
  constexpr double kMost = 1 << 20;
  if (!(width >= 1 && width <= kMost && height >= 1 && height <= kMost))
    throw Error(ErrorCode::kBadInput, where + ": has no valid size of its picture");
  view.lens.width = int(width);
  view.lens.height = int(height);
  set_projection(view, next, where);
  check(view.lens, where);
  next += 9;
  if (words.size() == kWithDistortion) {
    if (next[0] != 0 || next[1] != 0 || next[2] != 0)
      throw Error(ErrorCode::kBadInput,
                  where + ": has a distortion; only undistorted pictures can be read");
    next += 3;
  }
  StatedPose matrix;
  matrix << Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(next),
      Eigen::Vector3d(next[9], next[10], next[11]);
  set_pose(view, matrix, {"RDF", false}, where);
  return view;
}

std::unique_ptr<const Reader> strecha_reader() { return std::make_unique<StrechaReader>(); }

}  // namespace gigaray
