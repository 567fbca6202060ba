// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "rig_options.h"

#include <algorithm>
#include <cctype>

#include "numbers.h"

namespace gigaray::cli {
namespace {

std::string check_unit(const std::string& text) {
  constexpr std::size_t kLongest = 16;
  const bool is_word = !text.empty() && text.size() <= kLongest &&
                       std::all_of(text.begin(), text.end(), [](unsigned char letter) {
                         return std::isalpha(letter) || letter >= 0x80;
                       });
  return is_word ? std::string() : "is '" + text + "'; it must be the name of a unit, as m or mm";
}

}  // namespace

void add_rig_options(CLI::App& app, StatedRig& rig) {
  app.add_option("--focal-px", rig.focal_px,
                 "Views on a line or in a grid: focal length in px of the pictures as they are "
                 "(mm / width of the sensor in mm × width in px); with --baseline depth is in "
                 "scene units")
      ->check(above_zero())
      ->type_name("F");
  app.add_option("--baseline", rig.baseline,
                 "Views on a line or in a grid: distance of neighbouring views, scene units per "
                 "view step")
      ->check(above_zero())
      ->type_name("B");
  app.add_option("--focus-distance", rig.focus_distance,
                 "Views on a line or in a grid that are shifted towards each other: the distance "
                 "that has disparity 0, scene units (default: infinity)")
      ->check(above_zero())
      ->type_name("Z");
  app.add_option("--unit", rig.unit, "Name of the scene unit: m, mm, …")->check(check_unit);
}

}  // namespace gigaray::cli
