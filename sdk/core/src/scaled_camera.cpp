// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/scaled_camera.h"

#include <algorithm>

namespace gigaray {

Camera scaled(const Camera& camera, double by_u, double by_v) {
  constexpr double kRounding = 1e-9;
  Camera result = camera;
  result.focal_u *= by_u;
  result.focal_v *= by_v;
  // The corner is half a pixel beside the centre of the first one.
  result.centre_u = (camera.centre_u + 0.5) * by_u - 0.5;
  result.centre_v = (camera.centre_v + 0.5) * by_v - 0.5;
  result.width = std::max(1, int(camera.width * by_u + kRounding));
  result.height = std::max(1, int(camera.height * by_v + kRounding));
  return result;
}

}  // namespace gigaray
