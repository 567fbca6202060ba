// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "finished_maps.h"

namespace gigaray {

void FinishedMaps::put(int view, MapView<const float> disparity, MapView<const float> confidence,
                       MapView<const std::int8_t> level) {
  const std::size_t floats = std::size_t(width_) * sizeof(float);
  for (int v = disparity.rows().begin; v < disparity.rows().end; ++v) {
    const int row = view * height_ + v;
    rows_.write(row, 0, floats, disparity.row(v));
    rows_.write(row, floats, floats, confidence.row(v));
    rows_.write(row, 2 * floats, std::size_t(width_), level.row(v));
  }
}

void FinishedMaps::read(int view, int v, float* disparity, float* confidence,
                        std::int8_t* level) const {
  const std::size_t floats = std::size_t(width_) * sizeof(float);
  const int row = view * height_ + v;
  if (disparity) rows_.read(row, 0, floats, disparity);
  if (confidence) rows_.read(row, floats, floats, confidence);
  if (level) rows_.read(row, 2 * floats, std::size_t(width_), level);
}

}  // namespace gigaray
