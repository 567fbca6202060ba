// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/metric_depth.h"

#include "gigaray/core/arguments.h"

namespace gigaray {

bool has_metric_depth(const RigGeometry& rig) { return rig.focal_px && rig.baseline; }

FloatMap depth_from_disparity(const FloatMap& disparity, const RigGeometry& rig) {
  require_argument(has_metric_depth(rig), "rig: depth needs its focal_px and baseline");
  const double scale = *rig.focal_px * *rig.baseline;
  const double infinity =
      rig.focus_distance ? scale / *rig.focus_distance : 0;  // its disparity, −d
  FloatMap depth = disparity;
  for (float& value : depth)
    value = value + infinity > 0 ? float(scale / (value + infinity)) : kNoEstimate;
  return depth;
}

bool has_metric_depth(const LightField& light_field) {
  return light_field.kind == LightFieldKind::kUnstructured || has_metric_depth(light_field.rig);
}

FloatMap depth_from_disparity(const FloatMap& disparity, const LightField& light_field) {
  if (light_field.kind != LightFieldKind::kUnstructured)
    return depth_from_disparity(disparity, light_field.rig);
  FloatMap depth = disparity;
  for (float& value : depth) value = value > 0 ? 1 / value : kNoEstimate;
  return depth;
}

double disparity_of_depth(double depth, const LightField& light_field) {
  require_argument(has_metric_depth(light_field), "rig: depth needs its focal_px and baseline");
  require_argument(depth > 0, "depth: must be a distance above 0");
  if (light_field.kind == LightFieldKind::kUnstructured) return 1 / depth;
  const RigGeometry& rig = light_field.rig;
  const double scale = *rig.focal_px * *rig.baseline;
  return scale / depth - (rig.focus_distance ? scale / *rig.focus_distance : 0);
}

}  // namespace gigaray
