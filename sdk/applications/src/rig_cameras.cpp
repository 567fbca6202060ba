// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/rig_cameras.h"

#include <algorithm>

#include "gigaray/core/arguments.h"
#include "gigaray/core/metric_depth.h"

namespace gigaray {

RigCameras::RigCameras(const LightField& light_field, double least_disparity)
    : kind_(light_field.kind), width_(light_field.width), height_(light_field.height) {
  if (kind_ == LightFieldKind::kUnstructured) {
    cameras_ = light_field.cameras;
    return;
  }
  require_argument(width_ >= 1 && height_ >= 1, "light_field: has no width and height");
  require_argument(std::isfinite(least_disparity), "least_disparity: must be a finite number");
  const RigGeometry& rig = light_field.rig;
  is_metric_ = has_metric_depth(rig);
  principal_point_ = {0.5 * (width_ - 1), 0.5 * (height_ - 1)};
  if (rig.principal_point) principal_point_ = *rig.principal_point;
  focal_ = is_metric_ ? *rig.focal_px : std::max(width_, height_);
  step_ = is_metric_ ? *rig.baseline : 1;
  scale_ = focal_ * step_;
  if (is_metric_)
    at_infinity_ = rig.focus_distance ? scale_ / *rig.focus_distance : 0;
  else
    // A little behind the farthest thing, so that it has a depth.
    at_infinity_ = least_disparity > 0 ? 0 : 0.1 - least_disparity;
  for (const View& view : light_field.views) cameras_.push_back(camera_at(view.s, view.t));
}

Camera RigCameras::camera_at(double s, double t) const {
  require_argument(kind_ != LightFieldKind::kUnstructured,
                   "unstructured light fields have no camera at a position s, t");
  Camera camera;
  camera.width = width_;
  camera.height = height_;
  camera.focal_u = camera.focal_v = focal_;
  camera.centre_u = principal_point_.x() + s * at_infinity_;
  camera.centre_v = principal_point_.y() + t * at_infinity_;
  camera.translation = -step_ * Eigen::Vector3d(s, t, 0);
  return camera;
}

FloatMap RigCameras::inverse_depth(const FloatMap& disparity) const {
  FloatMap map = disparity;
  for (float& value : map) {
    const double inverse = (value + at_infinity_) / scale_;
    value = inverse > 0 ? float(inverse) : kNoEstimate;
  }
  return map;
}

}  // namespace gigaray
