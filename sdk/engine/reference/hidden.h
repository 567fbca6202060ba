// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "jump_sides.h"

namespace gigaray::reference {

/// Does every other view see a more confident estimate where it sees that of a pixel, or none see
/// it? See hidden.cl. apart: hypothesis units.
template <RaySampler S>
bool is_hidden(const S& sampler, int ref, int u, int v, int height, const HypothesisRange& range,
               double apart, MapView<const float> disparity, MapView<const float> confidence) {
  const int width = disparity.width(), count = hidden_steps(range, apart);
  const float h = disparity.row(v)[u], own = confidence.row(v)[u];
  const auto loses = [&](int other) {
    for (int i = 0; i < count; ++i) {
      const double tested = range.min + i * apart;
      if (!(std::abs(tested - h) > (1 - HIDDEN_NEAR) * apart)) continue;
      const auto pixel = pixel_before(sampler, ref, other, u, v, tested, h);
      if (!pixel || std::abs(pixel->second - v) >= HIDDEN_REACH) continue;
      const auto [x, y] = *pixel;
      if (!(x > -0.5 && x < width - 0.5 && y > -0.5 && y < height - 0.5)) continue;
      const int at_u = int(std::nearbyint(x)), at_v = int(std::nearbyint(y));
      const float there = disparity.row(at_v)[at_u];
      if (std::abs(there - tested) <= HIDDEN_NEAR * apart && std::abs(there - h) > apart &&
          confidence.row(at_v)[at_u] > own)
        return true;
    }
    return false;
  };
  for (int other = 0; other < sampler.num_views(); ++other) {
    if (other == ref) continue;
    const auto at = sampler.locate(ref, other, Ray{double(u), double(v), h});
    if (!at || !(at->u >= 0 && at->u <= width - 1 && at->v >= 0 && at->v <= height - 1)) continue;
    if (!loses(other)) return false;
  }
  return true;
}

/// What is hidden, and what few of the estimates around share; `guessed` of the rows.
void find_specks(RowRange rows, int height, float apart, MapView<const std::uint8_t> todo,
                 MapView<const float> disparity, MapView<const std::uint8_t> hidden,
                 MapView<std::uint8_t> guessed);

/// What is guessed continues the farther end of its gap in the row, in place.
void fill_hidden(RowRange rows, float apart, MapView<const std::uint8_t> guessed,
                 MapView<float> disparity, MapView<float> confidence);

}  // namespace gigaray::reference
