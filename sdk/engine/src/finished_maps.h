// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "estimates.h"
#include "row_store.h"
#include "strip_map.h"

namespace gigaray {

/// What was searched on a coarser level: [v][active view][u] Search.
struct LevelSearch {
  LevelShape shape;
  RowStore rows;
};

/// Maps of all active views as the engine leaves them: hypotheses, before the final median. In
/// memory or in a file. Any number of threads may read.
class FinishedMaps {
 public:
  static constexpr std::size_t kPixelBytes = 2 * sizeof(float) + 1;

  FinishedMaps() = default;
  /// folder: for the file; empty: in memory.
  FinishedMaps(int views, int width, int height, const std::string& folder)
      : width_(width),
        height_(height),
        rows_(views * height, std::size_t(width) * kPixelBytes, folder) {}

  bool empty() const { return rows_.empty(); }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Some rows of a view. Different rows may be put by different threads.
  void put(int view, MapView<const float> disparity, MapView<const float> confidence,
           MapView<const std::int8_t> level);
  /// A row of each; null: not wanted.
  void read(int view, int v, float* disparity, float* confidence, std::int8_t* level) const;

 private:
  int width_ = 0, height_ = 0;
  RowStore rows_;  ///< [view][v]: disparity, confidence, level
};

}  // namespace gigaray
