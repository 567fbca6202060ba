// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// transforms.json of nerfstudio and instant-ngp, transforms_train.json of NeRF's synthetic scenes,
// https://docs.nerf.studio/quickstart/data_conventions.html: camera → scene, axes right, up, back
// (OpenGL); pixels with corners at integers, as COLMAP's.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "formats/stated_views.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kName = "transforms.json";

/// What a frame states, else the file for all frames.
class Entries {
 public:
  Entries(const json& root, const json& frame, std::string where)
      : root_(root), frame_(frame), where_(std::move(where)) {}

  [[noreturn]] void bad(const std::string& what) const {
    throw Error(ErrorCode::kBadInput, where_ + ": " + what);
  }
  const std::string& where() const { return where_; }

  std::optional<double> number(const char* key) const {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number() || !std::isfinite(value->get<double>()))
      bad(std::string(key) + " is no finite number");
    return value->get<double>();
  }

  std::string text(const char* key) const {
    const json* value = find(key);
    if (!value) return {};
    if (!value->is_string()) bad(std::string(key) + " is no text");
    return value->get<std::string>();
  }

  int size(const char* key) const {
    constexpr double kMost = 1 << 20;
    const double value = number(key).value_or(0);
    if (value < 0 || value > kMost || value != std::floor(value))
      bad(std::string(key) + " is no size of a picture");
    return int(value);
  }

  const json* find(const char* key) const {
    const json* own = find_in(frame_, key);
    return own ? own : find_in(root_, key);
  }
  /// As find, but what the frame says with other words goes before what the file says.
  const json* find_own(const char* key) const {
    return find_in(frame_, "fl_x") ? find_in(frame_, key) : find(key);
  }

 private:
  static const json* find_in(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && !found->is_null() ? &*found : nullptr;
  }

  const json& root_;
  const json& frame_;
  std::string where_;
};

/// Numbers of a matrix, by rows: a list of rows or of numbers; null is NaN. Empty when it is none.
std::vector<double> flat(const json& matrix) {
  std::vector<double> numbers;
  const auto take = [&](const json& number) {
    if (number.is_number()) numbers.push_back(number.get<double>());
    if (number.is_null()) numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    return number.is_number() || number.is_null();
  };
  if (!matrix.is_array()) return {};
  for (const json& row : matrix)
    if (row.is_array() ? row.size() != matrix[0].size() || !std::ranges::all_of(row, take)
                       : !take(row))
      return {};
  return numbers;
}

/// Rows of 4 numbers, 3 or 4 of them.
StatedPose matrix_of(const Entries& entries) {
  const json* matrix = entries.find("transform_matrix");
  if (!matrix) entries.bad("has no transform_matrix");
  const std::vector<double> numbers = flat(*matrix);
  if (numbers.size() != 12 && numbers.size() != 16)
    entries.bad("transform_matrix is no matrix of 4 × 4 numbers");
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
}

/// fx, fy, cx, cy: of the entries fl_x …, or of a matrix K of 3 × 3 or 4 × 4 numbers. Without a
/// principal point: NaN. Empty: neither is stated.
std::optional<std::array<double, 4>> intrinsics_of(const Entries& entries) {
  constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();
  for (const char* key : {"K", "intrinsics", "intrinsic_matrix", "camera_intrinsics"}) {
    const json* matrix = entries.find_own(key);
    if (!matrix) continue;
    const std::vector<double> k = flat(*matrix);
    if (k.size() == 4) return std::array{k[0], k[1], k[2], k[3]};
    if (k.size() != 9 && k.size() != 16) entries.bad(std::string(key) + " is no matrix of 3 × 3");
    const std::size_t row = k.size() == 9 ? 3 : 4;
    constexpr double kMostSkew = 1e-3;  // px
    if (!(std::abs(k[1]) <= kMostSkew))
      entries.bad(std::string(key) + " has a skew, which no camera here can have");
    return std::array{k[0], k[row + 1], k[2], k[row + 2]};
  }
  const std::optional<double> focal = entries.number("fl_x");
  if (!focal) return std::nullopt;
  return std::array{*focal, entries.number("fl_y").value_or(*focal),
                    entries.number("cx").value_or(kNotStated),
                    entries.number("cy").value_or(kNotStated)};
}

/// The camera model under the names that writers of such files give it: FULL_OPENCV, OPENCV_FISHEYE
/// or one that can't be read.
std::string model_of(const Entries& entries) {
  static constexpr std::array kPerspective{"",       "PINHOLE",     "SIMPLE_PINHOLE",
                                           "OPENCV", "PERSPECTIVE", "SIMPLE_RADIAL",
                                           "RADIAL", "BROWN",       "FULL_OPENCV"};
  static constexpr std::array kFisheye{"OPENCV_FISHEYE", "FISHEYE", "SIMPLE_FISHEYE",
                                       "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE"};
  const std::string stated = upper(entries.text("camera_model"));
  const json* is_fisheye = entries.find("is_fisheye");  // instant-ngp
  const bool is_marked = is_fisheye && is_fisheye->is_boolean() && is_fisheye->get<bool>();
  if (is_marked || std::ranges::find(kFisheye, stated) != kFisheye.end()) return "OPENCV_FISHEYE";
  if (std::ranges::find(kPerspective, stated) == kPerspective.end())
    entries.bad("has the camera_model " + in_quotes(entries.text("camera_model")) +
                "; OPENCV, OPENCV_FISHEYE, PINHOLE, SIMPLE_RADIAL and their like can be read");
  if (stated != "FULL_OPENCV" && entries.number("k4").value_or(0) != 0)
    entries.bad("has a k4, which only OPENCV_FISHEYE can have here");
  return "FULL_OPENCV";
}

void set_lens(StatedView& view, const Entries& entries, const std::array<double, 4>& intrinsics) {
  Lens& lens = view.lens;
  lens.width = entries.size("w");
  lens.height = entries.size("h");
  if ((lens.width == 0) != (lens.height == 0)) entries.bad("states one of w and h alone");
  lens.model = model_of(entries);
  lens.params.assign(intrinsics.begin(), intrinsics.end());
  if (std::isnan(intrinsics[2]) != std::isnan(intrinsics[3]))
    entries.bad("states one of cx and cy alone");
  if (std::isnan(intrinsics[2])) {
    view.is_centred = true;
    lens.params[2] = lens.width / 2.0;
    lens.params[3] = lens.height / 2.0;
  }
  const auto add = [&](std::initializer_list<const char*> keys) {
    for (const char* key : keys) lens.params.push_back(entries.number(key).value_or(0));
  };
  if (lens.model == "OPENCV_FISHEYE")
    add({"k1", "k2", "k3", "k4"});
  else
    add({"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"});
  if (lens.width > 0) check(lens, entries.where());
}

StatedView view_of(const Entries& entries) {
  StatedView view;
  view.picture = entries.text("file_path");
  if (view.picture.empty()) entries.bad("has no file_path");
  view.mask = entries.text("mask_path");
  if (const auto intrinsics = intrinsics_of(entries)) {
    set_lens(view, entries, *intrinsics);
  } else if (const auto angle = entries.number("camera_angle_x")) {
    if (!(*angle > 0 && *angle < std::numbers::pi))
      entries.bad("camera_angle_x is no angle between 0 and π");
    view.field_of_view = angle;
  } else {
    entries.bad("states neither fl_x nor camera_angle_x");
  }
  set_pose(view, matrix_of(entries), {"RUB", false}, entries.where());
  return view;
}

/// Has a file of JSON frames with poses? Looks at its beginning.
bool states_frames(const fs::path& path) {
  if (lower(path.extension().string()) != ".json") return false;
  constexpr std::uint64_t kHead = 1 << 16;
  std::string head;
  try {
    head = InputFile(path).read(0, kHead);
  } catch (const Error&) {
    return false;
  }
  std::erase(head, '\0');  // UTF-16
  return head.find("\"frames\"") != std::string::npos &&
         head.find("\"transform_matrix\"") != std::string::npos;
}

/// The files of cameras that an input means, the one that is read first: itself; of a folder
/// transforms.json, else transforms_train.json and those of its kind.
std::vector<fs::path> files_of_cameras(const fs::path& input) {
  std::error_code ignored;
  if (fs::is_regular_file(input, ignored))
    return input.filename() == kName || states_frames(input) ? std::vector{input}
                                                             : std::vector<fs::path>();
  if (!fs::is_directory(input, ignored)) return {};
  if (fs::is_regular_file(input / kName, ignored)) return {input / kName};
  std::vector<fs::path> found;
  for (const fs::path& path : files_of(input)) {
    if (!lower(path.filename().string()).starts_with("transforms") || !states_frames(path))
      continue;
    const bool is_train = lower(path.stem().string()) == "transforms_train";
    found.insert(is_train ? found.begin() : found.end(), path);
  }
  return found;
}

/// Python writes NaN and Infinity, which JSON doesn't have.
std::string with_null_for_nan(std::string_view text) {
  std::string valid;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (is_quoted && text[i] == '\\' && i + 1 < text.size()) valid += text[i++];
    if (!is_quoted) {
      const std::string_view rest = text.substr(i);
      for (const std::string_view word : {"-Infinity", "Infinity", "-NaN", "NaN"})
        if (rest.starts_with(word)) {
          valid += "null";
          i += word.size();
          break;
        }
      if (i == text.size()) break;
    }
    valid += text[i];
  }
  return valid;
}

json json_of(std::string_view text) {
  json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) root = json::parse(with_null_for_nan(text), nullptr, false);
  return root;
}

/// The file of points that nerfstudio writes beside the cameras; empty: none.
std::string points_stated_in(const std::string& text) {
  if (text.find("\"ply_file_path\"") == std::string::npos) return {};
  const json root = json_of(text);
  if (!root.is_object()) return {};
  const auto found = root.find("ply_file_path");
  return found != root.end() && found->is_string() ? found->get<std::string>() : std::string();
}

class TransformsJsonReader : public Reader {
 public:
  std::string name() const override { return kName; }

  ProbeResult probe(const fs::path& input) const override {
    std::error_code ignored;
    const bool is_named = fs::is_regular_file(input, ignored);
    return {files_of_cameras(input).empty() ? 0 : is_named ? 90 : 75, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "transforms.json states");
    const std::vector<fs::path> files = files_of_cameras(input);
    const fs::path &file = files.front(), folder = file.parent_path();
    const std::string text = read_json_text(file, options.memory_bytes);
    LightField light_field =
        open_stated_views(parse_transforms_json(text, file.string()), file,
                          {folder, folder / "images"}, options, kName, points_stated_in(text));
    std::string others;
    for (std::size_t i = 1; i < files.size(); ++i)
      others += (others.empty() ? "" : ", ") + files[i].filename().string();
    if (file.filename() != kName && !fs::is_regular_file(input))
      light_field.notes.insert(
          light_field.notes.begin(),
          "the cameras are those of " + file.filename().string() +
              (others.empty() ? "" : "; name a file as INPUT for those of " + others));
    return light_field;
  }
};

}  // namespace

std::vector<StatedView> parse_transforms_json(std::string_view text, const std::string& where) {
  const json root = json_of(text);
  if (!root.is_object())
    throw Error(ErrorCode::kBadInput, where + ": is damaged or no JSON object");
  const auto frames = root.find("frames");
  if (frames == root.end() || !frames->is_array())
    throw Error(ErrorCode::kBadInput, where + ": has no list of frames");
  std::vector<StatedView> views;
  for (const json& frame : *frames) {
    const std::string place = where + ", frame " + std::to_string(views.size());
    StatedView view;
    try {
      if (!frame.is_object()) throw Error(ErrorCode::kBadInput, place + ": is no object");
      view = view_of(Entries(root, frame, place));
    } catch (const Error& problem) {
      // One frame does not refuse the capture; it has to be told from the others.
      const auto path = frame.is_object() ? frame.find("file_path") : frame.end();
      const bool is_named = frame.is_object() && path != frame.end() && path->is_string();
      view = StatedView();
      view.picture = is_named ? path->get<std::string>() : place;
      view.fault = problem.what();
    }
    views.push_back(std::move(view));
  }
  return views;
}

std::unique_ptr<const Reader> transforms_json_reader() {
  return std::make_unique<TransformsJsonReader>();
}

}  // namespace gigaray
