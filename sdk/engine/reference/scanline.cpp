// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "scanline.h"

#include "kernels/kernel_params.h"

namespace gigaray::reference {
namespace {

struct Pixel {
  int u, v;
};

/// Follows pixels begin, begin + (du, dv), … `count` of them; adds to `sum` in `keep`.
void follow(const Band& band, int ref, const SupportOptions& options,
            MapView<const std::uint8_t> todo, const Scores& scores, Pixel at, int du, int dv,
            int count, RowRange keep, Scores& sum) {
  const int last = scores.count - 1;
  std::vector<float> before, now(scores.count);
  for (; count > 0; --count, at.u += du, at.v += dv) {
    if (!todo.row(at.v)[at.u]) {
      before.clear();
      continue;
    }
    for (int i = 0; i <= last; ++i) now[i] = scores.at(at.u, at.v, i);
    if (!before.empty()) {
      const float change =
          colour_distance(band.pixel(ref, at.u, at.v), band.pixel(ref, at.u - du, at.v - dv));
      const float jump =
          std::max(options.jump_price * std::exp(-change / options.jump_sigma_colour),
                   options.small_price / 2);
      const float two_steps = std::min(options.small_price, jump);
      const float best = *std::max_element(before.begin(), before.end());
      for (int i = 0; i <= last; ++i) {
        float from = std::max(before[i], best - jump);
        for (const int d : {-2, -1, 1, 2})
          if (i + d >= 0 && i + d <= last)
            from = std::max(from, before[i + d] - two_steps * float(std::abs(d)) / 2);
        now[i] += from - best;
      }
    }
    if (keep.contains(at.v))
      for (int i = 0; i <= last; ++i) sum.at(at.u, at.v, i) += now[i];
    before = now;
  }
}

}  // namespace

Scores scanline(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                MapView<const std::uint8_t> todo, const Scores& scores) {
  const int width = scores.width, height = band.shape.height;
  Scores sum(rows, scores.count, width);
  std::fill(sum.data.begin(), sum.data.end(), 0.0f);
  for (int v = rows.begin; v < rows.end; ++v) {
    follow(band, ref, options, todo, scores, {0, v}, 1, 0, width, rows, sum);
    follow(band, ref, options, todo, scores, {width - 1, v}, -1, 0, width, rows, sum);
  }
  for (int begin = rows.begin; begin < rows.end; begin += SCANLINE_BLOCK) {
    const RowRange keep{begin, std::min(begin + SCANLINE_BLOCK, rows.end)};
    const RowRange path = grown(keep, SCANLINE_REACH, height);
    for (int u = 0; u < width; ++u) {
      follow(band, ref, options, todo, scores, {u, path.begin}, 0, 1, path.size(), keep, sum);
      follow(band, ref, options, todo, scores, {u, path.end - 1}, 0, -1, path.size(), keep, sum);
    }
  }
  return sum;
}

}  // namespace gigaray::reference
