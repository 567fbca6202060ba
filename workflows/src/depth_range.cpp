// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "depth_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gigaray/core/metric_depth.h"

namespace gigaray {
namespace {

Error refused(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// Factor that two ranges of numbers above 0 have in common, as a share of the factor that holds
/// both.
double agreement(const DisparityRange& a, const DisparityRange& b) {
  const double common = std::log(std::min(a.max, b.max) / std::max(a.min, b.min));
  return std::max(common, 0.0) / std::log(std::max(a.max, b.max) / std::min(a.min, b.min));
}

/// Without 0, for ratios.
DisparityRange above_zero(double min, double max) {
  constexpr double kLeast = 1e-3;  // of the largest
  return {std::max(min, kLeast * max), max};
}

}  // namespace

DisparityRange range_of(const DistanceRange& distances, const LightField& light_field) {
  const auto [near, far] = distances;
  if (!(near > 0) || std::isinf(near))
    throw refused(fmt::format("`distances` {:g} {:g}: NEAR must be a distance above 0", near, far));
  if (!(far > near))
    throw refused(fmt::format("`distances` {:g} {:g}: NEAR must be less than FAR", near, far));
  if (!has_metric_depth(light_field))
    throw refused(
        "`distances`: distances need a known rig; state it with `focal_px` and `baseline`, or "
        "disparities with `disparity`");
  return {disparity_of_depth(far, light_field), disparity_of_depth(near, light_field)};
}

void check_inverse_depth(const DisparityRange& stated, const LightField& light_field,
                         const RunControl& control) {
  const bool all_known = std::ranges::all_of(
      light_field.cameras, [](const Camera& camera) { return camera.inverse_depth.has_value(); });
  // What is no range, the options of the engine refuse.
  if (light_field.kind != LightFieldKind::kUnstructured || !all_known ||
      !(stated.max > stated.min) || stated.min < 0)
    return;
  const InverseDepthRange inverse = all_inverse_depths(light_field.cameras);
  const DisparityRange seen = above_zero(inverse.min, inverse.max);
  const DisparityRange meant = above_zero(stated.min, stated.max);
  const double as_depth = agreement({1 / meant.max, 1 / meant.min}, seen);
  const bool apart = stated.min > inverse.max || stated.max < inverse.min;
  const std::string text = fmt::format(
      "`disparity` {:g} {:g} of photographs with cameras is inverse depth, of which they "
      "see {:.3g} … {:.3g}",
      stated.min, stated.max, inverse.min, inverse.max);
  const std::string instead =
      fmt::format("`distances` {:g} {:g} states distances", stated.min, stated.max);
  if (stated.min > inverse.max && as_depth > 0) throw refused(text + "; " + instead);
  constexpr double kClearly = 2;
  if (apart || as_depth > kClearly * agreement(meant, seen))
    control.message(text + (as_depth > 0 ? "; " + instead : std::string()));
}

}  // namespace gigaray
