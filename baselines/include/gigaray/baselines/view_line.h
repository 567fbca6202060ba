// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "gigaray/baselines/baseline.h"

namespace gigaray::baselines {

enum class Direction { kRow, kColumn };

/// Another view of the row, or column, of the problem's view.
struct Neighbour {
  int view = 0;
  double steps = 0;  ///< from the problem's view along s, or t; signed
};

/// The problem's view itself (0 steps) and the others of its row or column, rising, one per place:
/// the nearest of those that are off by less than a quarter of a step and by less than half a pixel
/// across. None of unstructured views.
std::vector<Neighbour> views_along(const Problem& problem, Direction direction);

/// The view as CV_8UC3, of a column transposed: a point at (u, v) of the problem's view is at
/// (u − steps · d, v) either way.
cv::Mat picture_along(const Problem& problem, int view, Direction direction);

}  // namespace gigaray::baselines
