// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

namespace gigaray {

/// A place that a view has depth of, and the views that have it at the same depth.
struct AgreedPoint {
  Eigen::Vector3d position;
  std::array<std::uint8_t, 3> rgb{};
  std::vector<std::pair<std::size_t, Eigen::Vector3d>> sights;  ///< index; u, v, depth there
};

/// Some pixels of every view, on a grid, and the points on which two of them or more agree: a
/// sparse cloud as structure from motion has one.
class AgreedPoints {
 public:
  /// depth: scene units, NaN where there is none; of the size of the camera's picture.
  void add(const Camera& camera, const Image<std::uint16_t>& picture, int bit_depth,
           const FloatMap& depth);
  void visit(const std::function<void(const AgreedPoint&)>& take) const;

 private:
  struct Raster {
    Camera camera;
    int step = 1;  ///< px
    FloatMap depth;
    Image<std::uint8_t> colours;
  };
  std::vector<Raster> rasters_;
};

}  // namespace gigaray
