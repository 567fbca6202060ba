// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/adapters/colmap_model.h"
#include "gigaray/camera.h"
#include "gigaray/image.h"

namespace gigaray {

/// A dense workspace of COLMAP, ready for its stereo_fusion: undistorted pictures, a model of their
/// pinhole cameras, depth and normal maps.
class ColmapDense {
 public:
  explicit ColmapDense(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// depth: scene units, NaN where there is none; all of the size of the camera's picture.
  void add(const std::string& view, const Camera& camera, const Image<std::uint16_t>& picture,
           int bit_depth, const FloatMap& depth);
  /// Writes the model, and which maps there are. Its points are places on which views agree: from
  /// them COLMAP takes which pictures overlap.
  void finish();

 private:
  /// Some pixels of a view, on a grid.
  struct Raster {
    Camera camera;
    int step = 1;  ///< px
    FloatMap depth;
    Image<std::uint16_t> colours;
  };
  void add_points();

  std::filesystem::path folder_;
  ColmapModel model_;
  std::vector<Raster> rasters_;
  int bit_depth_ = 8;
};

}  // namespace gigaray
