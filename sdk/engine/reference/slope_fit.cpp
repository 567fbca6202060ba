// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "slope_fit.h"

namespace gigaray::reference {

void slope_fit(const Band& band, int ref, RowRange rows, float step, float max_slope,
               MapView<const std::uint8_t> todo, MapView<const float> in, MapView<Slope> slopes) {
  constexpr int kStride = 3, kSamples = 5;
  static_assert(kStride * kSamples == kSlopeReach);
  constexpr float kSigmaColour = 0.05f, kSigmaSpace = 8;
  const int width = band.shape.width, height = band.shape.height;
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!todo.row(v)[u]) continue;
      Slope slope;
      const float own = in.row(v)[u];
      for (const float hypotheses : {12.0f, 6.0f, 3.0f}) {
        const float scale = hypotheses * step;
        // Normal equations of two unknowns; a little weight on "no slope" keeps them solvable.
        float uu = 1e-3f, uv = 0, vv = 1e-3f, ud = 0, vd = 0;
        for (int j = -kSamples; j <= kSamples; ++j) {
          for (int i = -kSamples; i <= kSamples; ++i) {
            const int du = kStride * i, dv = kStride * j;
            if (u + du < 0 || u + du >= width || v + dv < 0 || v + dv >= height) continue;
            const float rise = in.row(v + dv)[u + du] - own;
            if (std::isnan(rise)) continue;
            const float residual = (rise - slope.along_u * du - slope.along_v * dv) / scale;
            const float biweight = std::max(1 - residual * residual, 0.0f);
            const float colour =
                colour_distance(band.pixel(ref, u + du, v + dv), band.pixel(ref, u, v)) /
                kSigmaColour;
            const float space = float(du * du + dv * dv) / (kSigmaSpace * kSigmaSpace);
            const float w = std::exp(-(colour * colour + space) / 2) * biweight * biweight;
            uu += w * du * du;
            uv += w * du * dv;
            vv += w * dv * dv;
            ud += w * du * rise;
            vd += w * dv * rise;
          }
        }
        const float determinant = uu * vv - uv * uv;
        slope = {std::clamp((vv * ud - uv * vd) / determinant, -max_slope, max_slope),
                 std::clamp((uu * vd - uv * ud) / determinant, -max_slope, max_slope)};
      }
      slopes.row(v)[u] = slope;
    }
  }
}

}  // namespace gigaray::reference
