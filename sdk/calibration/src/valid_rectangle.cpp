// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <vector>

#include "gigaray/calibration/rectifying_rotation.h"

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

/// Columns of the raster between which all is valid, and rows.
struct Cells {
  int column = 0, row = 0, columns = 0, rows = 0;
  long area() const { return long(columns) * rows; }
};

/// The largest rectangle under a skyline: heights of bars of width 1.
Cells largest_under(const std::vector<int>& heights, int bottom) {
  Cells best;
  std::vector<int> rising;  // bars whose rectangles are still open
  for (int i = 0; i <= int(heights.size()); ++i) {
    const int height = i < int(heights.size()) ? heights[i] : 0;
    while (!rising.empty() && heights[rising.back()] >= height) {
      const int top = heights[rising.back()];
      rising.pop_back();
      const int left = rising.empty() ? 0 : rising.back() + 1;
      const Cells cells{left, bottom - top, i - left, top};
      if (cells.area() > best.area()) best = cells;
    }
    rising.push_back(i);
  }
  return best;
}

}  // namespace

std::optional<PixelRectangle> largest_valid_rectangle(
    const PixelRectangle& bounds, int step, const std::function<bool(int u, int v)>& valid) {
  require_argument(step >= 1, "step: must be 1 or more");
  require_argument(bool(valid), "valid: is empty");
  const int columns = (bounds.width - 1) / step, rows = (bounds.height - 1) / step;
  if (columns < 1 || rows < 1) return std::nullopt;
  const auto row_of_raster = [&](int row) {
    std::vector<bool> nodes(columns + 1);
    for (int i = 0; i <= columns; ++i) nodes[i] = valid(bounds.u + i * step, bounds.v + row * step);
    return nodes;
  };
  Cells best;
  std::vector<int> heights(columns, 0);
  std::vector<bool> above = row_of_raster(0);
  for (int row = 1; row <= rows; ++row) {
    const std::vector<bool> below = row_of_raster(row);
    for (int i = 0; i < columns; ++i)
      heights[i] = above[i] && above[i + 1] && below[i] && below[i + 1] ? heights[i] + 1 : 0;
    const Cells cells = largest_under(heights, row);
    if (cells.area() > best.area()) best = cells;
    above = below;
  }
  if (best.area() == 0) return std::nullopt;
  return PixelRectangle{bounds.u + best.column * step, bounds.v + best.row * step,
                        best.columns * step + 1, best.rows * step + 1};
}

}  // namespace gigaray
