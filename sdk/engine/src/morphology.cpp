// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "morphology.h"

#include <algorithm>
#include <cmath>

namespace gigaray {
namespace {

std::uint8_t least(std::uint8_t a, std::uint8_t b) { return std::min(a, b); }
std::uint8_t most(std::uint8_t a, std::uint8_t b) { return std::max(a, b); }

/// Minimum or maximum over a pixel and its four neighbours; outside the picture nothing counts.
template <class Pick>
StripMap<std::uint8_t> over_cross(const StripMap<std::uint8_t>& in, RowRange rows, int height,
                                  Pick pick) {
  StripMap<std::uint8_t> out(in.width(), rows);
  for (int v = rows.begin; v < rows.end; ++v) {
    const std::uint8_t* above = in.row(std::max(v - 1, 0));
    const std::uint8_t* here = in.row(v);
    const std::uint8_t* below = in.row(std::min(v + 1, height - 1));
    for (int u = 0; u < in.width(); ++u) {
      const std::uint8_t left = here[std::max(u - 1, 0)];
      const std::uint8_t right = here[std::min(u + 1, in.width() - 1)];
      out.row(v)[u] = pick(pick(pick(above[u], below[u]), pick(left, right)), here[u]);
    }
  }
  return out;
}

}  // namespace

StripMap<std::uint8_t> open_mask(const StripMap<std::uint8_t>& mask, RowRange rows, int height,
                                 int radius) {
  StripMap<std::uint8_t> open = mask;
  for (int i = 2 * radius - 1; i >= radius; --i)
    open = over_cross(open, grown(rows, i, height), height, least);
  for (int i = radius - 1; i >= 0; --i)
    open = over_cross(open, grown(rows, i, height), height, most);
  return open;
}

void dilate(int radius, int height, StripMap<std::uint8_t>& todo,
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

bool any_set(const StripMap<std::uint8_t>& mask, RowRange rows) {
  for (int v = rows.begin; v < rows.end; ++v)
    if (std::any_of(mask.row(v), mask.row(v) + mask.width(), [](auto x) { return x != 0; }))
      return true;
  return false;
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
  dilate(reach, rows.end, beside, unused);
  return beside;
}

}  // namespace gigaray
