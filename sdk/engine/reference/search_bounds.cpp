// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "reference/search_bounds.h"

#include <algorithm>
#include <cmath>

namespace gigaray {
namespace {

struct Interval {
  float low = kNoEstimate, high = kNoEstimate;
  bool known() const { return !std::isnan(low); }
  void join(Interval other) {
    if (!other.known()) return;
    *this = known() ? Interval{std::min(low, other.low), std::max(high, other.high)} : other;
  }
};

}  // namespace

HypothesisBounds hypotheses_between(float low, float high, int margin,
                                    const HypothesisRange& range) {
  const auto index = [&](double h) {
    return std::clamp((h - range.min) / range.step(), 0.0, double(range.count - 1));
  };
  const int first = std::max(int(std::floor(index(low))) - margin, 0);
  const int last = std::min(int(std::ceil(index(high))) + margin, range.count - 1);
  return {std::uint16_t(first), std::uint16_t(last)};
}

void coarsen_bounds(std::span<const PackedEstimate> estimates, std::span<const Search> search,
                    int width, const HypothesisRange& range, std::span<Search> coarse) {
  std::fill(coarse.begin(), coarse.end(), Search{});
  std::vector<Interval> known(width), from_left(width);
  for (std::size_t row = 0; row < estimates.size() / width; ++row) {
    const auto here = estimates.subspan(row * width, width);
    const auto finer = search.empty() ? search : search.subspan(row * width, width);
    const auto has_estimate = [&](int u) {
      return here[u] != 0 || (!finer.empty() && std::isnan(finer[u].low));
    };
    for (int u = 0; u < width; ++u) {
      known[u] = {};
      if (here[u] != 0) known[u] = {hypothesis_of(here[u]), hypothesis_of(here[u])};
      if (!finer.empty()) known[u].join({finer[u].known_low, finer[u].known_high});
    }
    Interval nearest;
    for (int u = 0; u < width; ++u) {
      from_left[u] = nearest;
      if (known[u].known()) nearest = known[u];
    }
    nearest = {};
    for (int u = width - 1; u >= 0; --u) {
      Search& out = coarse[u / 2];
      Interval joined{out.known_low, out.known_high};
      joined.join(known[u]);
      out.known_low = joined.low;
      out.known_high = joined.high;
      if (!has_estimate(u)) {
        Interval bounds{float(range.min), float(range.max)};
        if (from_left[u].known() && nearest.known()) {
          bounds = from_left[u];
          bounds.join(nearest);
          bounds.join(known[u]);
        }
        bounds.join({out.low, out.high});
        out.low = bounds.low;
        out.high = bounds.high;
      }
      if (known[u].known()) nearest = known[u];
    }
  }
}

HypothesisBounds bounds_of(const Search& search, const HypothesisRange& range) {
  return hypotheses_between(search.low, search.high, 1, range);
}

void bound_thin_holes(RowRange rows, MapView<const std::uint8_t> todo,
                      MapView<const std::uint8_t> wide, MapView<const float> estimates,
                      const HypothesisRange& range, MapView<HypothesisBounds> bounds) {
  constexpr int kAround = 2 * kThinHole;  // px
  constexpr int kMargin = 8;              // hypotheses
  const int width = todo.width(), height = todo.rows().size();
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < width; ++u) {
      if (!todo.row(v)[u] || wide.row(v)[u]) continue;
      Interval around;
      for (int y = std::max(v - kAround, 0); y <= std::min(v + kAround, height - 1); ++y)
        for (int x = std::max(u - kAround, 0); x <= std::min(u + kAround, width - 1); ++x)
          around.join({estimates.row(y)[x], estimates.row(y)[x]});
      if (around.known())
        bounds.row(v)[u] = hypotheses_between(around.low, around.high, kMargin, range);
    }
}

}  // namespace gigaray
