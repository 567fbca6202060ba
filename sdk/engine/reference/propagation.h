// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"
#include "gigaray/depth_options.h"

namespace gigaray::reference {

/// Writes accepted estimates into every active view that sees them in a similar colour
/// (section 4.4). active_views: their places in the band, -1: not there. bars, estimates:
/// [state_rows][active view][width]. An arrival that is not more confident than a bar above 0 is
/// left out; null: no bars. Of those that meet the largest packed number stays, in any order.
template <RaySampler S>
void propagation(const Band& band, const S& sampler, int ref, RowRange rows,
                 const std::vector<int>& active_views, const PropagationOptions& options,
                 const StripMap<float>& disparity, const StripMap<float>& confidence,
                 const StripMap<Radiance>& radiance, RowRange state_rows, const float* bars,
                 PackedEstimate* estimates) {
  const int width = band.shape.width;
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < width; ++u) {
      const float h = disparity.row(v)[u];
      if (std::isnan(h)) continue;
      const Radiance& mean = radiance.row(v)[u];
      for (std::size_t target = 0; target < active_views.size(); ++target) {
        const int view = active_views[target];
        if (view < 0) continue;
        const auto there = sampler.locate(ref, view, Ray{double(u), double(v), h});
        if (!there) continue;
        const double x = std::floor(there->u + 0.5), y = std::floor(there->v + 0.5);
        if (x < 0 || x >= width || y < 0 || y >= band.shape.height) continue;
        if (!state_rows.contains(int(y))) continue;
        const bool similar =
            view == ref || colour_distance(band.pixel(view, int(x), int(y)),
                                           {mean.r, mean.g, mean.b}) < options.tolerance;
        if (!similar) continue;
        const std::size_t at =
            (std::size_t(int(y) - state_rows.begin) * active_views.size() + target) * width +
            int(x);
        if (bars && bars[at] > 0 && !(confidence.row(v)[u] > bars[at])) continue;
        estimates[at] =
            std::max(estimates[at], pack_estimate(float(there->hypothesis), confidence.row(v)[u]));
      }
    }
  }
}

}  // namespace gigaray::reference
