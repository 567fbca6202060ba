// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "gigaray/adapters/depth_result.h"
#include "gigaray/segmentation.h"

namespace gigaray::cli {

/// The interval of disparity (of photographs with cameras inverse depth) around a pixel of the view
/// whose maps stand at top level, and what it is in the other views.
class PixelInterval {
 public:
  /// at: U V. tolerance: px per view step to both sides, of photographs a share of the inverse
  /// depth; empty: as far as the surface goes, see interval_around(). disparity: the map of the
  /// view. Throws Error(kInvalidArgument) for a pixel outside of the picture or without an
  /// estimate (in `disparity`, which may lack what is unsure), and for a tolerance that reaches
  /// infinity.
  PixelInterval(const DepthResult& depth, const FloatMap& disparity, const std::vector<int>& at,
                std::optional<double> tolerance);

  float value() const { return value_; }
  /// In the view of the pixel.
  ValueInterval values() const { return values_; }
  /// In any view. Of photographs around the depth that the point has in that camera, by the same
  /// share; nothing where it lies behind the camera.
  ValueInterval values_in(int view) const;
  nlohmann::ordered_json json() const;

 private:
  const LightField& geometry_;
  int view_;
  std::vector<int> at_;
  float value_ = 0;
  ValueInterval values_;
};

}  // namespace gigaray::cli
