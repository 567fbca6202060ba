// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "baselines/baseline.h"

namespace gigaray::baselines {

enum class Direction { kRow, kColumn };

/// Views of one row of the rig, or of one column with pictures transposed, so that either way a
/// point at (u, v) of the reference is at (u − steps[j] · d, v) of view j.
struct EpiStack {
  Direction direction = Direction::kRow;
  std::vector<int> views;     ///< of the light field
  std::vector<double> steps;  ///< from the reference, rising, about equally far apart
  int reference = 0;          ///< index into both
  int size() const { return int(views.size()); }
  std::vector<cv::Mat> pictures(const Problem& problem) const;  ///< CV_8UC3, one per view
  std::vector<int> views_from_reference() const;                ///< the reference, then the others
};

/// The stack around the problem's view, with no more than so many views on each side. Nothing when
/// there are fewer than three, or when they are not equally spaced.
std::optional<EpiStack> epi_stack(const Problem& problem, Direction direction, int most_each_side);

}  // namespace gigaray::baselines
