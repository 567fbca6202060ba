// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "src/workspace.h"

namespace gigaray::reference {

constexpr int kMaxChannels = 5;  ///< RGB, gx, gy
using Sample = std::array<float, kMaxChannels>;

/// Rows [rows.begin, rows.end) of all views at one level: channel values, unpadded.
struct Band {
  LevelShape shape;
  RowRange rows;
  int num_views = 0;
  int channels = 3;
  std::vector<float> data;  ///< [row][view][channel][u]

  float* plane(int view, int v, int c) {
    return data.data() +
           ((std::size_t(v - rows.begin) * num_views + view) * channels + c) * shape.width;
  }
  const float* plane(int view, int v, int c) const {
    return const_cast<Band*>(this)->plane(view, v, c);
  }
  Sample pixel(int view, int u, int v) const {
    Sample sample{};
    for (int c = 0; c < channels; ++c) sample[c] = plane(view, v, c)[u];
    return sample;
  }
};

/// Euclidean distance of the RGB channels.
inline float colour_distance(const Sample& a, const Sample& b) {
  float sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

/// Weights of the taps at -1, 0, 1, 2 for a fraction f in [0, 1): Catmull-Rom or linear.
inline std::array<float, 4> tap_weights(float f, bool cubic) {
  if (!cubic) return {0, 1 - f, f, 0};
  const float f2 = f * f, f3 = f2 * f;
  return {-0.5f * f3 + f2 - 0.5f * f, 1.5f * f3 - 2.5f * f2 + 1, -1.5f * f3 + 2 * f2 + 0.5f * f,
          0.5f * f3 - 0.5f * f2};
}

/// A sample whose red is farther from the middle of all colours has a masked pixel in it
/// (kMaskedColour), which cubic taps may also take away; their overshoot is less.
constexpr float kMaskedBeyond = 1.5F;

/// Positions this near to a pixel centre are that centre, px. Otherwise rounding would decide
/// whether the last column is inside the picture.
inline double snapped(double x) {
  constexpr double kSnap = 1e-4;
  const double whole = std::round(x);
  return std::abs(x - whole) < kSnap ? whole : x;
}

/// The value of a view at a real position; empty outside the picture and where a masked pixel has
/// part in it. Taps beyond an edge repeat it.
inline std::optional<Sample> sample_at(const Band& band, int view, double u, double v, bool cubic) {
  const LevelShape& shape = band.shape;
  u = snapped(u);
  v = snapped(v);
  if (!(u >= 0 && u <= shape.width - 1 && v >= 0 && v <= shape.height - 1)) return std::nullopt;
  const int ui = int(u), vi = int(v);
  const auto wu = tap_weights(float(u - ui), cubic);
  const auto wv = tap_weights(float(v - vi), cubic);
  Sample sample{};
  for (int y = -1; y <= 2; ++y) {
    if (wv[y + 1] == 0) continue;
    const int row = std::clamp(vi + y, 0, shape.height - 1);
    for (int x = -1; x <= 2; ++x) {
      const int column = std::clamp(ui + x, 0, shape.width - 1);
      for (int c = 0; c < band.channels; ++c)
        sample[c] += wv[y + 1] * wu[x + 1] * band.plane(view, row, c)[column];
    }
  }
  if (std::abs(sample[0] - 0.5F) > kMaskedBeyond) return std::nullopt;
  return sample;
}

}  // namespace gigaray::reference
