// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "features/agreed_points.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

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
  void add_points();

  std::filesystem::path folder_;
  ColmapModel model_;
  AgreedPoints points_;
};

}  // namespace gigaray
