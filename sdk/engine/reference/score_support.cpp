// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "score_support.h"

namespace gigaray::reference {
namespace {

/// Supported scores of a strip. score_of(x, y, i) is what the neighbour (x, y) of (u, v)
/// contributes to hypothesis i.
template <class ScoreOf>
Scores support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
               MapView<const std::uint8_t> todo, MapView<const HypothesisBounds> bounds,
               const Scores& scores, ScoreOf score_of) {
  Scores supported(rows, scores.count, scores.width);
  for (int v = rows.begin; v < rows.end; ++v) {
    const RowRange window = grown({v, v + 1}, options.radius, band.shape.height);
    for (int u = 0; u < scores.width; ++u) {
      if (!todo.row(v)[u]) continue;
      const Sample own = band.pixel(ref, u, v);
      const auto [first, last] = bounds.row(v)[u];
      std::vector<float> sums(scores.count, 0);
      float weights = 0;
      for (int y = window.begin; y < window.end; ++y) {
        for (int x = std::max(u - options.radius, 0);
             x <= std::min(u + options.radius, scores.width - 1); ++x) {
          const float colour = colour_distance(band.pixel(ref, x, y), own) / options.sigma_colour;
          const float space = float((x - u) * (x - u) + (y - v) * (y - v)) /
                              (options.sigma_space * options.sigma_space);
          const float w = std::exp(-(colour * colour + space) / 2);
          weights += w;
          for (int i = first; i <= last; ++i) sums[i] += w * score_of(u, v, x, y, i);
        }
      }
      for (int i = first; i <= last; ++i) supported.at(u, v, i) = sums[i] / weights;
      supported.repeat_ends(u, v, bounds.row(v)[u]);
    }
  }
  return supported;
}

}  // namespace

Scores score_support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                     MapView<const std::uint8_t> todo, MapView<const HypothesisBounds> bounds,
                     const Scores& scores) {
  return support(band, ref, rows, options, todo, bounds, scores,
                 [&](int, int, int x, int y, int i) { return scores.at(x, y, i); });
}

Scores slanted_support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                       const HypothesisRange& hypotheses, MapView<const std::uint8_t> todo,
                       MapView<const HypothesisBounds> bounds, MapView<const Slope> slopes,
                       const Scores& scores) {
  const float step = float(hypotheses.step());
  return support(band, ref, rows, options, todo, bounds, scores,
                 [&](int u, int v, int x, int y, int i) {
                   const Slope& slope = slopes.row(v)[u];
                   const float shift = (slope.along_u * (x - u) + slope.along_v * (y - v)) / step;
                   const float at = std::clamp(i + shift, 0.0f, float(scores.count - 1));
                   const int whole = std::min(int(at), scores.count - 2);
                   const float low = scores.at(x, y, whole), high = scores.at(x, y, whole + 1);
                   return low + (at - whole) * (high - low);
                 });
}

}  // namespace gigaray::reference
