// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "rig_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "gigaray/metric_depth.h"
#include "numbers.h"

namespace gigaray::cli {
namespace {

Error refused(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// Focal lengths in mm and such in metres are what is stated by mistake.
void check_focal(double focal_px, int width, int height) {
  constexpr double kShortest = 0.1, kLongest = 1000;  // of the longer side of the picture
  const double side = std::max(width, height);
  if (focal_px >= kShortest * side && focal_px <= kLongest * side) return;
  constexpr double kDegrees = 180 / 3.14159265358979;
  throw refused(
      fmt::format("--focal-px {:g}: pictures of {} × {} px would have a field of view of {:.3g}°; "
                  "it is in px: focal length in mm / width of the sensor in mm × {}",
                  focal_px, width, height, 2 * std::atan(side / 2 / focal_px) * kDegrees, width));
}

std::string check_unit(const std::string& text) {
  constexpr std::size_t kLongest = 16;
  const bool is_word = !text.empty() && text.size() <= kLongest &&
                       std::all_of(text.begin(), text.end(), [](unsigned char letter) {
                         return std::isalpha(letter) || letter >= 0x80;
                       });
  return is_word ? std::string() : "is '" + text + "'; it must be the name of a unit, as m or mm";
}

/// Sets `value` where `stated` is one.
void replace(std::optional<double>& value, const std::optional<double>& stated, const char* option,
             LightField& light_field) {
  if (!stated) return;
  constexpr double kSame = 1e-6;
  if (value && std::abs(*stated / *value - 1) > kSame)
    light_field.notes.push_back(
        fmt::format("{} {:.6g} in place of {:.6g} that the input states", option, *stated, *value));
  value = stated;
}

}  // namespace

void RigOptions::change_unit(LightField& light_field) const {
  const RigGeometry& rig = light_field.rig;
  const char* other = rig.baseline && !baseline               ? "--baseline"
                      : rig.focus_distance && !focus_distance ? "--focus-distance"
                                                              : nullptr;
  if (other)
    throw refused(fmt::format("--unit {}: the input states lengths in {}; state {} too", unit,
                              rig.unit, other));
  light_field.notes.push_back(
      fmt::format("--unit {} in place of {} that the input states", unit, rig.unit));
}

void RigOptions::add_to(CLI::App& app) {
  app.add_option("--focal-px", focal_px,
                 "Views on a line or in a grid: focal length in px of the pictures as they are "
                 "(mm / width of the sensor in mm × width in px); with --baseline depth is in "
                 "scene units")
      ->check(above_zero())
      ->type_name("F");
  app.add_option("--baseline", baseline,
                 "Views on a line or in a grid: distance of neighbouring views, scene units per "
                 "view step")
      ->check(above_zero())
      ->type_name("B");
  app.add_option("--focus-distance", focus_distance,
                 "Views on a line or in a grid that are shifted towards each other: the distance "
                 "that has disparity 0, scene units (default: infinity)")
      ->check(above_zero())
      ->type_name("Z");
  app.add_option("--unit", unit, "Name of the scene unit: m, mm, …")->check(check_unit);
}

std::string RigOptions::stated() const {
  if (focal_px) return "--focal-px";
  if (baseline) return "--baseline";
  return focus_distance ? "--focus-distance" : "";
}

void RigOptions::apply(LightField& light_field) const {
  RigGeometry& rig = light_field.rig;
  if (light_field.kind == LightFieldKind::kUnstructured) {
    if (const std::string option = stated(); !option.empty())
      throw refused(option +
                    ": goes with views on a line or in a grid; the cameras of the format " +
                    light_field.format + " state it");
    if (!unit.empty() && !rig.unit.empty() && unit != rig.unit)
      throw refused(fmt::format("--unit {}: the cameras are in {}", unit, rig.unit));
    if (!unit.empty()) rig.unit = unit;
    return;
  }
  if (focal_px) check_focal(*focal_px, light_field.width, light_field.height);
  replace(rig.focal_px, focal_px, "--focal-px", light_field);
  replace(rig.baseline, baseline, "--baseline", light_field);
  replace(rig.focus_distance, focus_distance, "--focus-distance", light_field);
  if (!unit.empty()) {
    if (!rig.unit.empty() && unit != rig.unit) change_unit(light_field);
    rig.unit = unit;
  }
  if ((!stated().empty() || !unit.empty()) && !has_metric_depth(rig))
    light_field.notes.push_back(
        fmt::format("no depth in scene units: {} is not known ({} states it)",
                    rig.focal_px ? "the distance of neighbouring views" : "the focal length",
                    rig.focal_px ? "--baseline" : "--focal-px"));
}

}  // namespace gigaray::cli
