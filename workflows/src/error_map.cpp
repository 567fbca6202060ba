// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/error_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gigaray {
namespace {

using Rgb = std::array<double, 3>;

constexpr Rgb kNoEstimateColour{0, 0, 0}, kNotScored{128, 128, 128}, kRight{255, 255, 255},
    kTooFar{178, 10, 28}, kTooNear{10, 60, 160};

Rgb colour_of(double error, double range) {
  const Rgb& end = error < 0 ? kTooFar : kTooNear;
  const double share = std::min(1.0, std::abs(error) / range);
  Rgb colour;
  for (int c = 0; c < 3; ++c) colour[c] = kRight[c] + share * (end[c] - kRight[c]);
  return colour;
}

}  // namespace

Image<std::uint16_t> draw_error_map(const FloatMap& estimate, const FloatMap& truth, int border,
                                    double range) {
  const int width = truth.width(), height = truth.height();
  Image<std::uint16_t> picture(width, height, 3);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool inside = u >= border && v >= border && u < width - border && v < height - border;
      const double error = double(estimate(u, v)) - double(truth(u, v));
      const Rgb colour = !inside || !std::isfinite(truth(u, v)) ? kNotScored
                         : !std::isfinite(estimate(u, v))       ? kNoEstimateColour
                                                                : colour_of(error, range);
      for (int c = 0; c < 3; ++c) picture(u, v, c) = std::uint16_t(std::lround(colour[c]));
    }
  }
  return picture;
}

}  // namespace gigaray
