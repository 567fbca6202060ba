// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "baselines/transfer.h"

#include "gigaray/calibration/rectifying_rotation.h"

namespace gigaray::baselines {

double disparity_of_inverse_depth(const LightField& light_field, int view) {
  if (light_field.kind != LightFieldKind::kUnstructured) return 1;
  LightField placed = light_field;
  return light_field.cameras[view].focal_u * place_by_cameras(placed);
}

Eigen::Matrix<double, 3, 4> transfer(const LightField& light_field, int view, int other) {
  Eigen::Matrix<double, 3, 4> result = Eigen::Matrix<double, 3, 4>::Identity();
  if (light_field.kind != LightFieldKind::kUnstructured) {
    const View &from = light_field.views[view], &to = light_field.views[other];
    result.col(3) << from.s - to.s, from.t - to.t, 0;
    return result;
  }
  const Camera &from = light_field.cameras[view], &to = light_field.cameras[other];
  const Eigen::Vector3d way =
      to.translation - to.rotation * from.rotation.transpose() * from.translation;
  result.leftCols<3>() = homography_between(from, to);
  result.col(3) << to.focal_u * way.x() + to.centre_u * way.z(),
      to.focal_v * way.y() + to.centre_v * way.z(), way.z();
  result.col(3) /= disparity_of_inverse_depth(light_field, view);
  return result;
}

}  // namespace gigaray::baselines
