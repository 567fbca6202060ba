// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "jump_sides.h"

#include <limits>

namespace gigaray::reference {
namespace {

int squared(int x) { return x * x; }

/// visit(x, y, squared distance) for the pixels of the picture within a distance of (u, v).
template <class Visit>
void for_each_around(int u, int v, int radius, int distance2, int width, int height, Visit visit) {
  for (int y = std::max(v - radius, 0); y <= std::min(v + radius, height - 1); ++y)
    for (int x = std::max(u - radius, 0); x <= std::min(u + radius, width - 1); ++x)
      if (const int d2 = squared(x - u) + squared(y - v); d2 <= distance2) visit(x, y, d2);
}

/// Colours that one side shows around a pixel.
struct SideColours {
  float count = 0, squares = 0;
  std::array<float, 3> sum{};

  void add(const Sample& colour) {
    count += 1;
    for (int c = 0; c < 3; ++c) {
      sum[c] += colour[c];
      squares += colour[c] * colour[c];
    }
  }
  /// Mean squared distance from the mean.
  float spread2() const {
    float mean2 = 0;
    for (const float s : sum) mean2 += s * s / (count * count);
    return std::max(squares / count - mean2, 0.0f);
  }
};

/// From -1, the colours of the far side, to 1, those of the near one; less where they are alike.
float place_between(const SideColours& far, const SideColours& near, const Sample& own) {
  float apart2 = 0, along = 0;
  for (int c = 0; c < 3; ++c) {
    const float from = far.sum[c] / far.count, apart = near.sum[c] / near.count - from;
    apart2 += apart * apart;
    along += (own[c] - from) * apart;
  }
  const float place = std::clamp(2 * along / std::max(apart2, 1e-8f) - 1, -1.0f, 1.0f);
  return place * apart2 / (apart2 + far.spread2() + near.spread2() + 1e-4f);
}

}  // namespace

Sides sides_at(MapView<const float> disparity, int height, int u, int v, float jump) {
  Sides sides;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  const auto around = [&](auto visit) {
    for_each_around(u, v, SIDE_WINDOW, SIDE_WINDOW2, disparity.width(), height, visit);
  };
  around([&](int x, int y, int) {
    low = std::fmin(low, disparity.row(y)[x]);
    high = std::fmax(high, disparity.row(y)[x]);
  });
  if (!(high - low > jump)) return sides;
  sides.middle = 0.5f * (low + high);
  int near2 = std::numeric_limits<int>::max(), far2 = near2;
  around([&](int x, int y, int distance2) {
    const float d = disparity.row(y)[x];
    if (d >= sides.middle && distance2 < near2) {
      near2 = distance2;
      sides.near = d;
      sides.near_u = x;
      sides.near_v = y;
    } else if (d < sides.middle && distance2 < far2) {
      far2 = distance2;
      sides.far = d;
      sides.far_u = x;
      sides.far_v = y;
    }
  });
  return sides;
}

void choose_sides(const Band& own, int view, RowRange rows, float jump, float sigma_colour,
                  MapView<const float> disparity, MapView<const float> confidence,
                  MapView<const float> evidence, MapView<float> chosen,
                  MapView<float> chosen_confidence) {
  const int width = disparity.width(), height = own.shape.height;
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < width; ++u) {
      chosen.row(v)[u] = disparity.row(v)[u];
      chosen_confidence.row(v)[u] = confidence.row(v)[u];
      if (std::isnan(evidence.row(v)[u]) || std::isnan(disparity.row(v)[u])) continue;
      const Sides sides = sides_at(disparity, height, u, v, jump);
      const Sample here = own.pixel(view, u, v);
      float sum = 0, weights = 0;
      SideColours far, near;
      for_each_around(u, v, SIDE_COLOURS, squared(SIDE_COLOURS), width, height,
                      [&](int x, int y, int distance2) {
                        const Sample colour = own.pixel(view, x, y);
                        if (distance2 <= 2 && !std::isnan(evidence.row(y)[x])) {
                          const float d = colour_distance(colour, here) / sigma_colour;
                          const float w = std::exp(-0.5f * (d * d + float(distance2)));
                          sum += w * evidence.row(y)[x];
                          weights += w;
                        }
                        if (distance2 == 0 || std::isnan(disparity.row(y)[x]) ||
                            std::abs(colour[0] - 0.5F) > kMaskedBeyond)
                          return;
                        (disparity.row(y)[x] >= sides.middle ? near : far).add(colour);
                      });
      float answer = sum / weights;
      if (far.count >= SIDE_LEAST_COLOURS && near.count >= SIDE_LEAST_COLOURS)
        answer += SIDE_COLOUR_SHARE * place_between(far, near, here);
      const bool is_near = disparity.row(v)[u] >= sides.middle;
      if (is_near ? !(answer < -SIDE_LEAD) : !(answer > SIDE_LEAD)) continue;
      const int from_u = is_near ? sides.far_u : sides.near_u;
      const int from_v = is_near ? sides.far_v : sides.near_v;
      chosen.row(v)[u] = disparity.row(from_v)[from_u];
      chosen_confidence.row(v)[u] = confidence.row(from_v)[from_u];
    }
}

}  // namespace gigaray::reference
