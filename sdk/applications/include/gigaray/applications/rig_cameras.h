// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// The views of any light field as posed pinhole cameras, and disparity as inverse depth, so that
/// novel views, points and surfaces need not know which kind it is.
///
/// 3D and 4D: cameras at (s, t, 0) times the view step, looking along z, with the principal point
/// shifted so that disparity 0 is at the rig's focus. Scene units when focal length and view step
/// are known; else the focal length is taken as the longer side of the picture and the view step as
/// the unit, which changes depth by a projective map: exact for views in the plane of the cameras.
class RigCameras {
 public:
  /// least_disparity: of what is seen; where the focus is not known it decides what is at infinity.
  explicit RigCameras(const LightField& light_field, double least_disparity = 0);

  bool is_metric() const { return is_metric_; }
  const Camera& camera(int view) const { return cameras_[view]; }
  const std::vector<Camera>& cameras() const { return cameras_; }
  /// A camera of a 3D or 4D light field between the views, at (s, t) view steps.
  Camera camera_at(double s, double t) const;

  /// Of a view, from the unit of ViewDepth::disparity to 1 / scene unit. NaN stays; what is at
  /// infinity or beyond becomes NaN.
  FloatMap inverse_depth(const FloatMap& disparity) const;
  /// The other way.
  double disparity(double inverse_depth) const { return inverse_depth * scale_ - at_infinity_; }

 private:
  LightFieldKind kind_;
  bool is_metric_ = true;
  int width_ = 0, height_ = 0;
  Eigen::Vector2d principal_point_ = Eigen::Vector2d::Zero();  ///< px, at s = t = 0
  double focal_ = 0, step_ = 0;                                ///< px; scene units
  double scale_ = 1;                                           ///< f · B
  double at_infinity_ = 0;  ///< −disparity of a point at infinity
  std::vector<Camera> cameras_;
};

}  // namespace gigaray
