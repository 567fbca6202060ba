// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/stated_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gigaray/core/metric_depth.h"

namespace gigaray {
namespace {

Error refused(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// Focal lengths in mm and such in metres are what is stated by mistake.
void check_focal(double focal_px, int width, int height) {
  constexpr double kShortest = 0.1, kLongest = 1000;  // of the longer side of the picture
  const double side = std::max(width, height);
  if (focal_px >= kShortest * side && focal_px <= kLongest * side) return;
  constexpr double kDegrees = 180 / 3.14159265358979;
  throw refused(
      fmt::format("`focal_px` {:g}: pictures of {} × {} px would have a field of view of {:.3g}°; "
                  "it is in px: focal length in mm / width of the sensor in mm × {}",
                  focal_px, width, height, 2 * std::atan(side / 2 / focal_px) * kDegrees, width));
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

void StatedRig::change_unit(LightField& light_field) const {
  const RigGeometry& rig = light_field.rig;
  const char* other = rig.baseline && !baseline               ? "`baseline`"
                      : rig.focus_distance && !focus_distance ? "`focus_distance`"
                                                              : nullptr;
  if (other)
    throw refused(fmt::format("`unit` {}: the input states lengths in {}; state {} too", unit,
                              rig.unit, other));
  light_field.notes.push_back(
      fmt::format("`unit` {} in place of {} that the input states", unit, rig.unit));
}

std::string StatedRig::stated() const {
  if (focal_px) return "`focal_px`";
  if (baseline) return "`baseline`";
  return focus_distance ? "`focus_distance`" : "";
}

void StatedRig::apply(LightField& light_field) const {
  RigGeometry& rig = light_field.rig;
  if (light_field.kind == LightFieldKind::kUnstructured) {
    if (const std::string option = stated(); !option.empty())
      throw refused(option +
                    ": goes with views on a line or in a grid; the cameras of the format " +
                    light_field.format + " state it");
    if (!unit.empty() && !rig.unit.empty() && unit != rig.unit)
      throw refused(fmt::format("`unit` {}: the cameras are in {}", unit, rig.unit));
    if (!unit.empty()) rig.unit = unit;
    return;
  }
  if (focal_px) check_focal(*focal_px, light_field.width, light_field.height);
  replace(rig.focal_px, focal_px, "`focal_px`", light_field);
  replace(rig.baseline, baseline, "`baseline`", light_field);
  replace(rig.focus_distance, focus_distance, "`focus_distance`", light_field);
  if (!unit.empty()) {
    if (!rig.unit.empty() && unit != rig.unit) change_unit(light_field);
    rig.unit = unit;
  }
  if ((!stated().empty() || !unit.empty()) && !has_metric_depth(rig))
    light_field.notes.push_back(
        fmt::format("no depth in scene units: {} is not known ({} states it)",
                    rig.focal_px ? "the distance of neighbouring views" : "the focal length",
                    rig.focal_px ? "`baseline`" : "`focal_px`"));
}

}  // namespace gigaray
