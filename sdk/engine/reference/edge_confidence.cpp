// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "edge_confidence.h"

#include <cmath>

namespace gigaray::reference {

void edge_confidence(const Band& band, int ref, RowRange rows, const EdgeOptions& options,
                     bool both_axes, MapView<float> confidence) {
  const auto is_masked = [](const Sample& pixel) {
    return std::abs(pixel[0] - 0.5F) > kMaskedBeyond;
  };
  const auto difference = [&](const Sample& a, const Sample& b) {
    if (is_masked(b) && !is_masked(a)) return 0.0F;  // the rim of a mask is no edge of the scene
    const float distance = colour_distance(a, b);
    return options.squared ? distance * distance : distance;
  };
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < band.shape.width; ++u) {
      const Sample own = band.pixel(ref, u, v);
      float along_u = 0, along_v = 0;
      for (int k = -options.radius; k <= options.radius; ++k) {
        if (u + k >= 0 && u + k < band.shape.width)
          along_u += difference(own, band.pixel(ref, u + k, v));
        if (both_axes && v + k >= 0 && v + k < band.shape.height)
          along_v += difference(own, band.pixel(ref, u, v + k));
      }
      confidence.row(v)[u] = std::max(along_u, along_v);
    }
  }
}

}  // namespace gigaray::reference
