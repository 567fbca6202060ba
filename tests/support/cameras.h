// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/camera.h"

namespace gigaray::testing_support {

/// At the origin, looks ahead, principal point in the middle of the picture. focal: px.
inline Camera centred_camera(int width, int height, double focal) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.focal_u = camera.focal_v = focal;
  camera.centre_u = (width - 1) / 2.0;
  camera.centre_v = (height - 1) / 2.0;
  return camera;
}

}  // namespace gigaray::testing_support
