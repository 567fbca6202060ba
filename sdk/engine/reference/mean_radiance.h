// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Mean radiance r̄ (eq. 5) of every accepted estimate (not NaN) of the strip.
template <RaySampler S>
void mean_radiance(const Band& band, const S& sampler, int ref, RowRange rows,
                   const ScoreOptions& options, MapView<const float> disparity,
                   MapView<Radiance> radiance) {
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < disparity.width(); ++u) {
      const float h = disparity.row(v)[u];
      if (std::isnan(h)) continue;
      const auto samples = gather(band, sampler, ref, Ray{double(u), double(v), h}, false);
      const Sample mean = mean_shift(samples, band.pixel(ref, u, v), options,
                                     std::max(options.mean_shift_iterations, 1));
      radiance.row(v)[u] = {mean[0], mean[1], mean[2]};
    }
  }
}

}  // namespace gigaray::reference
