// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "gigaray/baselines/view_line.h"

namespace gigaray::baselines {

/// Views of one row or column, about equally far apart.
struct EpiStack {
  Direction direction = Direction::kRow;
  std::vector<Neighbour> views;  ///< rising
  int reference = 0;             ///< index of the problem's view
  int size() const { return int(views.size()); }
  double step() const;                                          ///< mean, view steps
  std::vector<int> views_from_reference() const;                ///< the reference, then the others
  std::vector<cv::Mat> pictures(const Problem& problem) const;  ///< picture_along, one per view
};

/// The stack around the problem's view, with no more than so many views on each side. Nothing when
/// there are fewer than three, or when they are not equally spaced.
std::optional<EpiStack> epi_stack(const Problem& problem, Direction direction, int most_each_side);

}  // namespace gigaray::baselines
