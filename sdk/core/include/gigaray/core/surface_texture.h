// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// The texture of a surface: one picture (an atlas), and where the triangles lie in it.
struct SurfaceTexture {
  Image<std::uint8_t> picture;  ///< sRGB (v, u, c)
  /// Of each face the places of its corners, in the order of the face: (u, v) from the top left
  /// corner of the picture (not the middle of its first pixel), in parts of its size, [0, 1].
  /// Triangles that hang together in the picture have bit-equal places at the vertices they share.
  std::vector<std::array<Eigen::Vector2f, 3>> corners;
};

}  // namespace gigaray
