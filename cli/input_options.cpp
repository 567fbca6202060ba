// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "input_options.h"

#include <map>
#include <regex>
#include <string>

#include "did_you_mean.h"
#include "rig_options.h"

namespace gigaray::cli {
namespace {

Travel way_of(const std::string& word, const std::string& text) {
  static const std::map<std::string, Travel> kWays{{"right", Travel::kRight},
                                                   {"left", Travel::kLeft},
                                                   {"down", Travel::kDown},
                                                   {"up", Travel::kUp}};
  const auto found = kWays.find(word);
  if (found == kWays.end())
    throw CLI::ValidationError("--direction",
                               "'" + text +
                                   "' is not one of right, left, down, up, two of them as in "
                                   "left,up, or auto" +
                                   did_you_mean(word, {"right", "left", "down", "up", "auto"}));
  return found->second;
}

void parse_direction(const std::string& text, OpenOptions& open) {
  open.direction = open.row_direction = Travel::kAuto;
  if (text == "auto") return;
  const auto comma = text.find(',');
  open.direction = way_of(text.substr(0, comma), text);
  if (comma != std::string::npos) open.row_direction = way_of(text.substr(comma + 1), text);
}

void parse_lenslet(const std::string& text, OpenOptions& open) {
  static const std::regex kSize(R"((\d{1,3})(?:x(\d{1,3}))?)");
  std::smatch match;
  if (!std::regex_match(text, match, kSize))
    throw CLI::ValidationError("--lenslet", "'" + text + "' is no grid size like 14 or 15x13");
  open.lenslet.columns = std::stoi(match[1]);
  open.lenslet.rows = match[2].matched ? std::stoi(match[2]) : open.lenslet.columns;
}

void parse_grid(const std::string& text, OpenOptions& open) {
  static const std::regex kSize(R"((\d{1,3})[xX](\d{1,3})(,snake)?)");
  std::smatch match;
  if (!std::regex_match(text, match, kSize) || std::stoi(match[1]) == 0 || std::stoi(match[2]) == 0)
    throw CLI::ValidationError(
        "--grid", "'" + text + "' is no number of rows and columns like 5x7 or 5x7,snake");
  open.grid = {std::stoi(match[1]), std::stoi(match[2]), match[3].matched};
}

void parse_convention(const std::string& text, OpenOptions& open) {
  open.convention = parse_pose_convention(text);
  if (!open.convention)
    throw CLI::ValidationError("--convention",
                               "'" + text +
                                   "' is not opencv, opengl, unity, llff, ros, unreal or three of "
                                   "R L U D F B as in RUB, with or without -w2c" +
                                   did_you_mean(text, {"opencv", "opengl", "unity", "llff", "ros",
                                                       "unreal", "opencv-w2c", "opengl-w2c"}));
}

}  // namespace

void InputOptions::add_to(CLI::App& app) {
  app.add_option("INPUT", path, "Folder or file of the light field")->required();
  app.add_option("--positions", open.positions,
                 "Text file: where each picture was taken, 'right', 'right down' or "
                 "'name right down' per line")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--direction", [this](const std::string& text) { parse_direction(text, open); },
         "Way of the camera as the numbers of the pictures rise: right, left, down or up; in a "
         "grid "
         "two of them, as the column (or x) and as the row (or y) rises: left,up (default: "
         "assumed, and found by `depth` where views agree best)")
      ->type_name("WAY");
  app.add_option_function<std::string>(
         "--grid", [this](const std::string& text) { parse_grid(text, open); },
         "Numbered pictures: rows and columns of a grid that the numbers go through row by row, as "
         "in 5x7; 5x7,snake: back along every second row (default: a line, unless they agree "
         "better as a grid)")
      ->type_name("RxC");
  app.add_option_function<std::string>(
         "--lenslet", [this](const std::string& text) { parse_lenslet(text, open); },
         "One lenslet picture: its views across and down, as in 14 or 15x13 (default: 14 for "
         "…_eslf)")
      ->type_name("N");
  app.add_option("--images", open.images,
                 "Folder of the photographs, when they don't lie with the model of their cameras")
      ->type_name("DIR");
  app.add_option("--masks", open.masks,
                 "Folder of masks, black is left out; NAME.png for the picture NAME")
      ->type_name("DIR");
  app.add_option_function<std::string>(
         "--convention", [this](const std::string& text) { parse_convention(text, open); },
         "Photographs with cameras: how the matrices of their poses are meant: opencv, opengl, "
         "unity, llff, ros, unreal or the ways of x, y and z as in RDF (right, down, forward); "
         "with -w2c behind it they take the scene to the camera (default: as the format has it)")
      ->type_name("NAME");
  app.add_flag(
      "--strict", open.strict,
      "A picture that is missing, damaged, without a finite pose or (in rows and grids) of "
      "another size is an error, not left out");
  app.add_option("--without", without,
                 "Leave these views out, as if they had not been taken: names, indices, ranges")
      ->type_name("LIST");
  app.add_option("--max-size", max_size,
                 "Shrink pictures that have more pixels than this on a side (default: as they are)")
      ->check(CLI::Range(16, 1 << 20))
      ->type_name("PX");
  add_rig_options(app, rig);
}

}  // namespace gigaray::cli
