// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// HCI 4D light field benchmark (Honauer et al. 2016), https://lightfield-analysis.uni-konstanz.de:
// input_CamNNN.png with NNN = row · columns + column from the top left camera, as seen from behind
// the rig, and parameters.cfg. Parallel cameras, sensors shifted so that focus_distance_m has
// disparity 0.
#include <cmath>
#include <map>
#include <regex>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/hci_parameters.h"
#include "formats/readers.h"
#include "formats/view_grid.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr int kUsualCameras = 9;  // per axis, in the published scenes

std::optional<int> camera_number(const fs::path& path) {
  static const std::regex kName(R"(input_Cam(\d{1,6}))");
  std::smatch match;
  const std::string stem = path.stem().string();
  if (!std::regex_match(stem, match, kName)) return std::nullopt;
  return std::stoi(match[1]);
}

std::map<int, fs::path> cameras_of(const fs::path& folder) {
  std::map<int, fs::path> cameras;
  for (const fs::path& path : pictures_of(folder))
    if (const auto number = camera_number(path)) {
      const auto [other, added] = cameras.emplace(*number, path);
      if (!added)
        throw Error(ErrorCode::kBadInput,
                    path.string() + ": is the same camera as " + other->second.filename().string());
    }
  return cameras;
}

void apply(const HciParameters& parameters, LightField& light_field) {
  const auto low = parameters.number("disp_min"), high = parameters.number("disp_max");
  if (low && high && *low < *high) light_field.declared_range = DisparityRange{*low, *high};

  const auto focal_mm = parameters.number("focal_length_mm");
  const auto sensor_mm = parameters.number("sensor_size_mm");
  if (focal_mm && sensor_mm && *sensor_mm > 0)  // the sensor's size is that of its longer side
    light_field.rig.focal_px =
        *focal_mm / *sensor_mm * std::max(light_field.width, light_field.height);
  if (const auto baseline_mm = parameters.number("baseline_mm"))
    light_field.rig.baseline = *baseline_mm / 1000;
  light_field.rig.focus_distance = parameters.number("focus_distance_m");
  light_field.rig.unit = "m";
}

// The origin in one axis: the middle of the declared grid, or of the cameras there are when they
// all stand on one side of it.
double origin(int cameras, int lowest, int highest) {
  const double middle = (cameras - 1) / 2.0;
  return lowest < middle && middle < highest ? middle : (lowest + highest) / 2.0;
}

/// Columns and rows of a grid that nothing states: numbers 0 … n² - 1 without a gap fill n × n.
int usual_side(const std::map<int, fs::path>& cameras) {
  const int count = int(cameras.size()), side = int(std::lround(std::sqrt(count)));
  const bool is_square = side > 1 && side * side == count && cameras.rbegin()->first == count - 1;
  return is_square ? side : kUsualCameras;
}

class HciReader : public Reader {
 public:
  std::string name() const override { return "HCI scene"; }

  ProbeResult probe(const fs::path& input) const override {
    for (const fs::path& path : pictures_of(input))
      if (camera_number(path)) return {60, ""};
    return {};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "an HCI scene states");
    const std::map<int, fs::path> cameras = cameras_of(input);
    LightField light_field;
    const fs::path parameter_file = input / "parameters.cfg";
    std::error_code ignored;
    std::optional<HciParameters> parameters;
    if (fs::exists(parameter_file, ignored))
      parameters.emplace(read_text(parameter_file), parameter_file.string());
    const int usual = usual_side(cameras);
    int columns = options.grid.columns, rows = options.grid.rows;
    if (rows == 0) {
      columns = parameters ? parameters->cameras("num_cams_x", kUsualCameras) : usual;
      rows = parameters ? parameters->cameras("num_cams_y", kUsualCameras) : usual;
    }
    const GridSize size{rows, columns, options.grid.snake};
    const std::string grid = std::to_string(columns) + "×" + std::to_string(rows);
    if (!parameters)
      light_field.notes.push_back(
          "no parameters.cfg: a grid of " + grid + " cameras is " +
          (options.grid.rows > 0 ? "stated" : "assumed (OpenOptions::grid states it)") +
          ", the disparity range and the rig are unknown");

    int left = columns, right = 0, top = rows, bottom = 0;
    for (const auto& [number, path] : cameras) {
      if (number >= columns * rows)
        throw Error(ErrorCode::kBadInput, path.string() + ": camera " + std::to_string(number) +
                                              " is outside a grid of " + grid +
                                              "; num_cams_x and num_cams_y in parameters.cfg or "
                                              "OpenOptions::grid state the grid");
      const GridCell cell = cell_of(number, size);
      left = std::min(left, cell.column);
      right = std::max(right, cell.column);
      top = std::min(top, cell.row);
      bottom = std::max(bottom, cell.row);
    }
    std::vector<fs::path> files;
    for (const auto& [number, path] : cameras) {
      View view;
      view.name = path.stem().string();
      const GridCell cell = cell_of(number, size);
      place_camera(view, cell.column - origin(columns, left, right),
                   cell.row - origin(rows, top, bottom));
      light_field.views.push_back(view);
      files.push_back(path);
    }
    if (int(files.size()) < columns * rows)
      light_field.notes.push_back(std::to_string(files.size()) + " of " +
                                  std::to_string(columns * rows) + " views of the grid are there");
    light_field.kind = kind_from_positions(light_field.views);
    attach_pictures(light_field, std::move(files), options);
    if (parameters) apply(*parameters, light_field);
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> hci_reader() { return std::make_unique<HciReader>(); }

}  // namespace gigaray
