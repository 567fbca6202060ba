// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/error.h"

namespace GIGARAY_API gigaray {

/// sRGB, 8 bit.
using Rgb8 = std::array<std::uint8_t, 3>;

/// Points of surfaces. All lists are equally long.
struct PointCloud {
  /// Where the cameras' scene has what is (0, 0, 0) here, exactly as a file states it. Other than 0
  /// for a scene so far from its own zero (UTM, ECEF) that floats are too coarse there.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> positions;  ///< scene units, relative to `origin`, the scene's axes
  std::vector<Eigen::Vector3f> normals;    ///< unit, to the side that cameras saw
  std::vector<Rgb8> colours;
  std::vector<float> confidences;  ///< [0, 1], as in ViewDepth::confidence
  std::vector<float> supports;  ///< other views that see the point there, mean of what was merged

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
};

/// Adds the points of `more` behind those of `cloud`, which has the same origin or no points yet:
/// else throws Error(kInvalidArgument).
inline void append(PointCloud& cloud, const PointCloud& more) {
  if (cloud.empty()) cloud.origin = more.origin;
  if (cloud.origin != more.origin)
    throw Error(ErrorCode::kInvalidArgument, "clouds with different origins can't be joined");
  const auto join = [](auto& list, const auto& other) {
    list.insert(list.end(), other.begin(), other.end());
  };
  join(cloud.positions, more.positions);
  join(cloud.normals, more.normals);
  join(cloud.colours, more.colours);
  join(cloud.confidences, more.confidences);
  join(cloud.supports, more.supports);
}

}  // namespace gigaray
