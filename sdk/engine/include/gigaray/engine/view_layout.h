// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// How the numbers of pictures go through a grid of cameras: run by run.
struct ViewLayout {
  int rows = 1;              ///< runs; 1: a line
  int columns = 1;           ///< views of a run
  bool alternating = false;  ///< every second run goes back
  bool operator==(const ViewLayout&) const = default;
};

/// How well some views agree when they stand in a layout.
struct LayoutTrial {
  ViewLayout layout;
  double agreement =
      0;  ///< of views in the middle, 0 … 1, see RangeEstimate; the better axes count
  double as_line = 0;  ///< of views around the end of a run, were they all on one line
};

/// How far the grid must be ahead of what the numbers would be else. Right grids lead the line by
/// 0.09 (hand-made gantries) to 0.26 (rendered), wrong ones are behind it or up to 0.02 ahead.
inline constexpr double kGridLead = 0.05;

/// Tries the grids that `num_cells` numbers fill without a rest, three views and more in a run;
/// two for up to 16 numbers. cells: the place of every view in the numbering, 0 … num_cells - 1,
/// rising. The best one first. Looks at 18 small pictures per grid.
std::vector<LayoutTrial> try_layouts(const LightField& light_field, const std::vector<int>& cells,
                                     int num_cells, const RunControl& control);

/// Agreement of the views in one layout, which may have a rest.
LayoutTrial try_layout(const LightField& light_field, const std::vector<int>& cells,
                       const ViewLayout& layout, const RunControl& control);

}  // namespace gigaray
