// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "reference/masks.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace gigaray {
namespace {

/// Minimum or maximum over a pixel and its four neighbours.
template <class Pick>
void over_cross(RowRange rows, int height, MapView<const std::uint8_t> in,
                MapView<std::uint8_t> out, Pick pick) {
  for (int v = rows.begin; v < rows.end; ++v) {
    const std::uint8_t* above = in.row(std::max(v - 1, 0));
    const std::uint8_t* here = in.row(v);
    const std::uint8_t* below = in.row(std::min(v + 1, height - 1));
    for (int u = 0; u < in.width(); ++u) {
      const std::uint8_t left = here[std::max(u - 1, 0)];
      const std::uint8_t right = here[std::min(u + 1, in.width() - 1)];
      out.row(v)[u] = pick({above[u], below[u], left, right, here[u]});
    }
  }
}

}  // namespace

void erode(RowRange rows, int height, MapView<const std::uint8_t> in, MapView<std::uint8_t> out) {
  over_cross(rows, height, in, out,
             [](std::initializer_list<std::uint8_t> cross) { return std::min(cross); });
}

void dilate(RowRange rows, int height, MapView<const std::uint8_t> in, MapView<std::uint8_t> out) {
  over_cross(rows, height, in, out,
             [](std::initializer_list<std::uint8_t> cross) { return std::max(cross); });
}

StripMap<std::uint8_t> open_mask(const StripMap<std::uint8_t>& mask, RowRange rows, int height,
                                 int radius) {
  StripMap<std::uint8_t> open = mask;
  const auto pass = [&](int around, auto step) {
    StripMap<std::uint8_t> next(mask.width(), grown(rows, around, height));
    step(next.rows(), height, MapView<const std::uint8_t>(open), next.view());
    open = std::move(next);
  };
  for (int i = 2 * radius - 1; i >= radius; --i) pass(i, [](auto... all) { erode(all...); });
  for (int i = radius - 1; i >= 0; --i) pass(i, [](auto... all) { dilate(all...); });
  return open;
}

void grow_todo(int radius, int height, StripMap<std::uint8_t>& todo,
               StripMap<HypothesisBounds>& bounds) {
  const int width = todo.width();
  const RowRange rows = todo.rows();
  GIGARAY_CHECK((rows == RowRange{0, height}));
  const auto join = [](std::uint8_t& todo, HypothesisBounds& bounds, std::uint8_t other_todo,
                       HypothesisBounds other) {
    if (!other_todo) return;
    bounds = todo ? HypothesisBounds{std::min(bounds.first, other.first),
                                     std::max(bounds.last, other.last)}
                  : other;
    todo = 1;
  };
  StripMap<std::uint8_t> along_u = todo;
  StripMap<HypothesisBounds> bounds_u = bounds;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      if (!todo.row(v)[u]) continue;
      for (int x = std::max(u - radius, 0); x <= std::min(u + radius, width - 1); ++x)
        join(along_u.row(v)[x], bounds_u.row(v)[x], 1, bounds.row(v)[u]);
    }
  todo = along_u;
  bounds = bounds_u;
  for (int v = 0; v < height; ++v)
    for (int y = std::max(v - radius, 0); y <= std::min(v + radius, height - 1); ++y) {
      if (y == v) continue;
      for (int u = 0; u < width; ++u)
        join(todo.row(v)[u], bounds.row(v)[u], along_u.row(y)[u], bounds_u.row(y)[u]);
    }
}

StripMap<std::uint8_t> close_cracks(int width, float apart, StripMap<float>& estimates,
                                    StripMap<float>& confidence) {
  const RowRange rows = estimates.rows();
  StripMap<std::uint8_t> filled(estimates.width(), rows);
  // All lines see the estimates as they came, so that the order of rows and columns does not matter
  // but for a hole that both could fill: the row does.
  const StripMap<float> carried = estimates;
  const auto fill_line = [&](int length, auto at) {
    int last = -1;  // the last estimate before
    for (int i = 0; i < length; ++i) {
      const auto [u, v] = at(i);
      const float after = carried.row(v)[u];
      if (std::isnan(after)) continue;
      const int holes = i - last - 1;
      if (last >= 0 && holes > 0 && holes <= width) {
        const auto [u0, v0] = at(last);
        const float before = carried.row(v0)[u0];
        if (std::abs(after - before) <= apart)
          for (int k = 1; k <= holes; ++k) {
            const auto [x, y] = at(last + k);
            if (filled.row(y)[x]) continue;
            filled.row(y)[x] = 1;
            estimates.row(y)[x] = before + (after - before) * float(k) / float(holes + 1);
            confidence.row(y)[x] = std::min(confidence.row(v0)[u0], confidence.row(v)[u]);
          }
      }
      last = i;
    }
  };
  struct Pixel {
    int u, v;
  };
  for (int v = rows.begin; v < rows.end; ++v)
    fill_line(estimates.width(), [&](int i) { return Pixel{i, v}; });
  for (int u = 0; u < estimates.width(); ++u)
    fill_line(rows.size(), [&](int i) { return Pixel{u, rows.begin + i}; });
  return filled;
}

StripMap<std::uint8_t> beside_jumps(const StripMap<float>& map, float jump, int reach) {
  const int width = map.width();
  const RowRange rows = map.rows();
  StripMap<std::uint8_t> beside(width, rows);
  const auto differ = [&](float a, float b) { return std::abs(a - b) > jump; };
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < width; ++u)
      beside.row(v)[u] = (u + 1 < width && differ(map.row(v)[u], map.row(v)[u + 1])) ||
                         (v + 1 < rows.end && differ(map.row(v)[u], map.row(v + 1)[u]));
  StripMap<HypothesisBounds> unused(width, rows);
  grow_todo(reach, rows.end, beside, unused);
  return beside;
}

}  // namespace gigaray
