// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// (New) Stanford Light Field Archive, http://lightfield.stanford.edu: out_ROW_COL_Y_X with the
// measured position of the camera; other words before ROW and after X are allowed, and more than
// one underscore between. That X grows to the right and Y downwards as the pictures show it is
// found on Lego Knights and an assumption for others: their axes differ.
#include <cmath>
#include <regex>
#include <set>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

struct Camera {
  int row = 0;
  int column = 0;
  double x = 0;
  double y = 0;
  fs::path path;
};

/// Four whole numbers may be anything, a date and a time; those of the archive begin with "out".
bool is_position(const std::string& stem, const std::string& y, const std::string& x) {
  const bool is_measured = (y + x).find_first_of(".-") != std::string::npos;
  return is_measured || lower(stem).starts_with("out_");
}

std::vector<Camera> cameras_of(const fs::path& folder) {
  static const std::regex kName(
      R"(.*?_+(\d{1,4})_+(\d{1,4})_+(-?\d+(?:\.\d+)?)_+(-?\d+(?:\.\d+)?)(_.*)?)");
  std::vector<Camera> cameras;
  for (const fs::path& path : pictures_of(folder)) {
    std::smatch match;
    const std::string stem = path.stem().string();
    if (std::regex_match(stem, match, kName) && is_position(stem, match[3], match[4]))
      cameras.push_back({std::stoi(match[1]), std::stoi(match[2]), *parse_number(match[4].str()),
                         *parse_number(match[3].str()), path});
  }
  return cameras;
}

// Text like "0.09" for a share of a step.
std::string hundredths(double value) {
  const long whole = std::lround(value * 100);
  return std::to_string(whole / 100) + "." + (whole % 100 < 10 ? "0" : "") +
         std::to_string(whole % 100);
}

class StanfordReader : public Reader {
 public:
  std::string name() const override { return "Stanford archive"; }

  ProbeResult probe(const fs::path& input) const override {
    return {cameras_of(input).empty() ? 0 : 50, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    const Directions directions = Directions::of_grid(options, Travel::kRight, Travel::kDown);
    const std::vector<Camera> cameras = cameras_of(input);
    std::set<int> rows, columns;
    for (const Camera& camera : cameras) {
      rows.insert(camera.row);
      columns.insert(camera.column);
    }
    // A gantry wobbles across its direction of travel. One row counts as exactly straight: its
    // views then form a 3D light field.
    const bool one_row = rows.size() == 1, one_column = columns.size() == 1;
    LightField light_field;
    std::vector<fs::path> files;
    double lowest = INFINITY, highest = -INFINITY;
    for (const Camera& camera : cameras) {
      View view;
      view.name = camera.path.stem().string();
      directions.place(view, one_column ? 0 : camera.x, one_row ? 0 : camera.y);
      light_field.views.push_back(view);
      files.push_back(camera.path);
      const double across = one_row ? camera.y : camera.x;
      lowest = std::min(lowest, across);
      highest = std::max(highest, across);
    }
    attach_pictures(light_field, std::move(files), options);
    if (light_field.num_views() >= 2)
      light_field.rig.baseline = normalise_positions(light_field.views);
    if (one_row != one_column)
      light_field.notes.push_back(
          std::string(one_row ? "one row" : "one column") +
          " of the grid: the measured wobble of " +
          hundredths((highest - lowest) / light_field.rig.baseline.value_or(1)) +
          " view steps across it is ignored");
    light_field.kind = kind_from_positions(light_field.views);
    light_field.sign_is_assumed = !directions.stated();
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> stanford_reader() { return std::make_unique<StanfordReader>(); }

}  // namespace gigaray
