// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// transforms.json of nerfstudio and instant-ngp,
// https://docs.nerf.studio/quickstart/data_conventions.html: camera → scene, axes right, up, back
// (OpenGL); pixels with corners at integers, as COLMAP's.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <system_error>

#include "camera_position.h"
#include "gigaray/adapters/input_file.h"
#include "readers.h"
#include "stated_views.h"
#include "text.h"

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
    for (const json* object : {&frame_, &root_})
      if (const auto found = object->find(key); found != object->end() && !found->is_null())
        return &*found;
    return nullptr;
  }

 private:
  const json& root_;
  const json& frame_;
  std::string where_;
};

/// Rows of 4 numbers, 3 or 4 of them.
Eigen::Matrix<double, 3, 4> matrix_of(const Entries& entries) {
  const json* matrix = entries.find("transform_matrix");
  if (!matrix) entries.bad("has no transform_matrix");
  const auto is_row = [](const json& row) {
    return row.is_array() && row.size() == 4 &&
           std::all_of(row.begin(), row.end(), [](const json& x) { return x.is_number(); });
  };
  if (!matrix->is_array() || matrix->size() < 3 || matrix->size() > 4 ||
      !std::all_of(matrix->begin(), matrix->end(), is_row))
    entries.bad("transform_matrix is no matrix of 4 × 4 numbers");
  Eigen::Matrix<double, 3, 4> out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      out(row, column) = (*matrix)[std::size_t(row)][std::size_t(column)].get<double>();
  return out;
}

Lens lens_of(const Entries& entries, double focal) {
  Lens lens;
  lens.width = entries.size("w");
  lens.height = entries.size("h");
  if (lens.width == 0 || lens.height == 0) entries.bad("states a focal length but not w and h");
  const auto number = [&](const char* key, double otherwise = 0) {
    return entries.number(key).value_or(otherwise);
  };
  const std::vector<double> pinhole = {focal, number("fl_y", focal), number("cx", lens.width / 2.0),
                                       number("cy", lens.height / 2.0)};
  const double k1 = number("k1"), k2 = number("k2"), k3 = number("k3"), k4 = number("k4");
  const double p1 = number("p1"), p2 = number("p2");
  std::string model = entries.text("camera_model");
  const json* is_fisheye = entries.find("is_fisheye");  // instant-ngp
  if (is_fisheye && is_fisheye->is_boolean() && is_fisheye->get<bool>()) model = "OPENCV_FISHEYE";
  lens.params = pinhole;
  if (model == "OPENCV_FISHEYE") {
    lens.model = model;
    lens.params.insert(lens.params.end(), {k1, k2, k3, k4});
  } else if (model.empty() || model == "OPENCV" || model == "PINHOLE" ||
             model == "SIMPLE_PINHOLE") {
    if (k4 != 0) entries.bad("has a k4, which only OPENCV_FISHEYE can have here");
    lens.model = "FULL_OPENCV";
    lens.params.insert(lens.params.end(), {k1, k2, p1, p2, k3, 0, 0, 0});
  } else {
    entries.bad("has the camera_model " + in_quotes(model) +
                "; OPENCV, OPENCV_FISHEYE and PINHOLE can be read");
  }
  check(lens, entries.where());
  return lens;
}

StatedView view_of(const Entries& entries) {
  StatedView view;
  view.picture = entries.text("file_path");
  if (view.picture.empty()) entries.bad("has no file_path");
  view.mask = entries.text("mask_path");
  if (const auto focal = entries.number("fl_x")) {
    view.lens = lens_of(entries, *focal);
  } else if (const auto angle = entries.number("camera_angle_x")) {
    if (!(*angle > 0 && *angle < std::numbers::pi))
      entries.bad("camera_angle_x is no angle between 0 and π");
    view.field_of_view = angle;
  } else {
    entries.bad("states neither fl_x nor camera_angle_x");
  }
  const Eigen::Matrix<double, 3, 4> pose = matrix_of(entries);
  Eigen::Matrix3d axes = pose.leftCols<3>();
  axes.rightCols<2>() *= -1;  // up → down, back → ahead
  set_pose(view, axes, pose.col(3), entries.where());
  return view;
}

fs::path file_of(const fs::path& input) {
  return input.filename() == kName ? input : input / kName;
}

class TransformsJsonReader : public Reader {
 public:
  std::string name() const override { return kName; }

  ProbeResult probe(const fs::path& input) const override {
    std::error_code ignored;
    const bool is_named = input.filename() == kName;
    return {fs::is_regular_file(file_of(input), ignored) ? (is_named ? 90 : 75) : 0, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "transforms.json states");
    const fs::path file = file_of(input);
    return open_stated_views(
        parse_transforms_json(read_json_text(file, options.memory_bytes), file.string()), file,
        {file.parent_path()}, options, kName);
  }
};

}  // namespace

std::vector<StatedView> parse_transforms_json(std::string_view text, const std::string& where) {
  const json root = json::parse(text, nullptr, false);
  if (!root.is_object())
    throw Error(ErrorCode::kBadInput, where + ": is damaged or no JSON object");
  const auto frames = root.find("frames");
  if (frames == root.end() || !frames->is_array())
    throw Error(ErrorCode::kBadInput, where + ": has no list of frames");
  std::vector<StatedView> views;
  for (const json& frame : *frames) {
    const std::string place = where + ", frame " + std::to_string(views.size());
    if (!frame.is_object()) throw Error(ErrorCode::kBadInput, place + ": is no object");
    views.push_back(view_of(Entries(root, frame, place)));
  }
  return views;
}

std::unique_ptr<const Reader> transforms_json_reader() {
  return std::make_unique<TransformsJsonReader>();
}

}  // namespace gigaray
