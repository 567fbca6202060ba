// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "bilateral_median.h"

namespace gigaray::reference {

void bilateral_median(const Band& band, int ref, RowRange rows, int radius, float tolerance,
                      MapView<const float> in, MapView<float> out) {
  const bool bilateral = std::isfinite(tolerance);
  std::vector<float> window;
  for (int v = rows.begin; v < rows.end; ++v) {
    const RowRange around = grown({v, v + 1}, radius, band.shape.height);
    for (int u = 0; u < in.width(); ++u) {
      out.row(v)[u] = kNoEstimate;
      if (std::isnan(in.row(v)[u])) continue;
      window.clear();
      for (int y = around.begin; y < around.end; ++y) {
        for (int x = std::max(u - radius, 0); x <= std::min(u + radius, in.width() - 1); ++x) {
          if (std::isnan(in.row(y)[x])) continue;
          if (bilateral &&
              !(colour_distance(band.pixel(ref, x, y), band.pixel(ref, u, v)) < tolerance))
            continue;
          window.push_back(in.row(y)[x]);
        }
      }
      if (window.empty()) continue;
      const auto middle = window.begin() + (window.size() - 1) / 2;
      std::nth_element(window.begin(), middle, window.end());
      out.row(v)[u] = *middle;
    }
  }
}

}  // namespace gigaray::reference
