// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "hidden.h"

namespace gigaray::reference {

void find_specks(RowRange rows, int height, float apart, MapView<const std::uint8_t> todo,
                 MapView<const float> disparity, MapView<const std::uint8_t> hidden,
                 MapView<std::uint8_t> guessed) {
  const RowRange columns{0, disparity.width()};
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < columns.end; ++u) {
      std::uint8_t& guess = guessed.row(v)[u];
      guess = hidden.row(v)[u];
      if (!todo.row(v)[u] || guess) continue;
      const RowRange ys = grown({v, v + 1}, SPECK_RADIUS, height);
      const RowRange xs = grown({u, u + 1}, SPECK_RADIUS, columns.end);
      int alike = 0;
      for (int y = ys.begin; y < ys.end; ++y)
        for (int x = xs.begin; x < xs.end; ++x)
          alike +=
              !hidden.row(y)[x] && std::abs(disparity.row(y)[x] - disparity.row(v)[u]) <= apart;
      guess = float(alike) < SPECK_SHARE * float(ys.size() * xs.size());
    }
}

void fill_hidden(RowRange rows, float apart, MapView<const std::uint8_t> guessed,
                 MapView<float> disparity, MapView<float> confidence) {
  const int width = disparity.width();
  for (int v = rows.begin; v < rows.end; ++v) {
    float* estimates = disparity.row(v);
    float* sure = confidence.row(v);
    const auto known = [&](int u) { return !guessed.row(v)[u] && sure[u] > 0; };
    for (int u = 0; u < width; ++u) {
      if (!guessed.row(v)[u]) continue;
      int left = u - 1, right = u + 1;
      while (left >= 0 && !known(left)) --left;
      while (right < width && !known(right)) ++right;
      if (left < 0 && right >= width) continue;
      const bool to_right = left < 0 || (right < width && estimates[right] < estimates[left]);
      const int from = to_right ? right : left;
      if (!(std::abs(estimates[u] - estimates[from]) <= apart)) estimates[u] = estimates[from];
      sure[u] = FILLED_CONFIDENCE * sure[from];
    }
  }
}

}  // namespace gigaray::reference
