// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Mean colours along the rays of the reference view's pixels: row v · channels + c of `means`
/// holds channel c of row v; gradients are left alone. NaN disparity: the pixel stays as it is.
template <RaySampler S>
void ray_mean(const Band& band, const S& sampler, int ref, RowRange rows,
              const ScoreOptions& options, MapView<const float> disparity, MapView<float> means) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < band.shape.width; ++u) {
      const Sample own = band.pixel(ref, u, v);
      const float d = disparity.row(v)[u];
      Sample sum{};
      float weights = 0;
      if (!std::isnan(d))
        for (const Sample& sample :
             gather(band, sampler, ref, Ray{double(u), double(v), d}, options.cubic)) {
          const float w = colour_kernel(sample, own, options);
          weights += w;
          for (int c = 0; c < 3; ++c) sum[c] += w * sample[c];
        }
      for (int c = 0; c < 3; ++c)
        means.row(v * band.channels + c)[u] = weights > 0 ? sum[c] / weights : own[c];
    }
}

}  // namespace gigaray::reference
