// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "score_support.h"

namespace gigaray::reference {

Scores score_support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                     const StripMap<std::uint8_t>& todo, const StripMap<HypothesisBounds>& bounds,
                     const Scores& scores) {
  Scores supported(rows, scores.count, scores.width);
  for (int v = rows.begin; v < rows.end; ++v) {
    const RowRange window = grown({v, v + 1}, options.radius, band.shape.height);
    for (int u = 0; u < scores.width; ++u) {
      if (!todo.row(v)[u]) continue;
      const Sample own = band.pixel(ref, u, v);
      std::vector<float> sums(scores.count, 0);
      float weights = 0;
      for (int y = window.begin; y < window.end; ++y) {
        for (int x = std::max(u - options.radius, 0);
             x <= std::min(u + options.radius, scores.width - 1); ++x) {
          const float colour = colour_distance(band.pixel(ref, x, y), own) / options.sigma_colour;
          const float space =
              float((x - u) * (x - u) + (y - v) * (y - v)) / (options.sigma_space * options.sigma_space);
          const float w = std::exp(-(colour * colour + space) / 2);
          weights += w;
          for (int i = bounds.row(v)[u].first; i <= bounds.row(v)[u].last; ++i)
            sums[i] += w * scores.at(x, y, i);
        }
      }
      for (int i = bounds.row(v)[u].first; i <= bounds.row(v)[u].last; ++i)
        supported.at(u, v, i) = sums[i] / weights;
    }
  }
  return supported;
}

}  // namespace gigaray::reference
