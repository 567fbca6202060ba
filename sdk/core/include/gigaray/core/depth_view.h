// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// A view with its camera, picture, depth and confidence: what novel views, points and surfaces are
/// made of. Picture and maps have the camera's size.
struct DepthView {
  Camera camera;                 ///< in scene units
  Image<std::uint16_t> picture;  ///< sRGB (v, u, c), 0 … 2^bit_depth − 1
  FloatMap inverse_depth;        ///< (v, u), 1 / scene unit; NaN: no estimate
  FloatMap confidence = {};      ///< (v, u), [0, 1]; empty: nothing is known of it
  int bit_depth = 8;             ///< 8 or 16
  Mask shown = {};               ///< 0: shows nothing of the scene; empty: all does

  /// A value of the picture in 8 bit.
  std::uint8_t byte(int u, int v, int c) const {
    return std::uint8_t(picture(u, v, c) >> (bit_depth - 8));
  }
};

/// Views of one scene, read when they are needed. `read` is called from one thread, for the same
/// view more than once; what it throws is passed on.
struct DepthViews {
  std::vector<Camera> cameras;
  std::function<DepthView(int view)> read;

  int size() const { return int(cameras.size()); }
};

}  // namespace gigaray
