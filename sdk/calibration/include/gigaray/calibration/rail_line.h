// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// The line with the least orthogonal distances to camera centres, as the paper takes it for the
/// baseline of a rail.
struct RailLine {
  Eigen::Vector3d origin;         ///< the mean of the centres, scene units
  Eigen::Vector3d direction;      ///< unit; the way from the first centre to the last one
  std::vector<double> positions;  ///< of the centres along the line, 0 at the origin; scene units
  std::vector<double> distances;  ///< of the centres from the line, scene units
  double rms_distance = 0;
  double max_distance = 0;
  /// Median distance of neighbours along the line, scene units; > 0.
  double median_step = 0;
};

/// centres: of cameras, in any order along the rail, scene units. Throws Error(kBadInput) for fewer
/// than 3, for a centre that is not finite, and when more than half of the neighbours stand at one
/// place.
RailLine fit_rail_line(const std::vector<Eigen::Vector3d>& centres);

/// Distances of neighbours in the order of their positions; one less than the positions.
std::vector<double> steps_between(std::vector<double> positions);

}  // namespace gigaray
