// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"
#include "estimates.h"
#include "gigaray/engine/depth_options.h"

namespace gigaray::reference {

/// Calls visit(target, view, x, y, hypothesis) for every pixel of an active view that an estimate
/// arrives at (section 4.4). active_views: their places in the band, -1: not there.
template <RaySampler S, class Visit>
void for_each_arrival(const S& sampler, int ref, RowRange rows,
                      const std::vector<int>& active_views, MapView<const float> disparity,
                      int height, RowRange reached, int targets, Visit visit) {
  const int width = disparity.width();
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < width; ++u) {
      const float h = disparity.row(v)[u];
      if (std::isnan(h)) continue;
      for (int target = 0; target < targets; ++target) {
        const int view = active_views[target];
        if (view < 0) continue;
        const auto there = sampler.locate(ref, view, Ray{double(u), double(v), h});
        if (!there) continue;
        const double x = std::floor(there->u + 0.5), y = std::floor(there->v + 0.5);
        if (x < 0 || x >= width || y < 0 || y >= height || !reached.contains(int(y))) continue;
        visit(u, v, target, int(x), int(y), float(there->hypothesis));
      }
    }
}

/// The first `finished` active views get a bar wherever an estimate arrives and none is yet:
/// bar_of() what they have.
template <RaySampler S>
void set_bars(const S& sampler, int ref, RowRange rows, const std::vector<int>& active_views,
              MapView<const float> disparity, int height, RowRange reached, int finished,
              float finished_lead, const StoredRows<PackedEstimate>& estimates,
              const StoredRows<float>& bars) {
  for_each_arrival(sampler, ref, rows, active_views, disparity, height, reached, finished,
                   [&](int, int, int target, int x, int y, float) {
                     float& bar = bars.at(y, target, x);
                     if (bar == 0) bar = bar_of(estimates.at(y, target, x), finished_lead);
                   });
}

/// Estimates arrive in every active view that sees them in a similar colour; in the first
/// `finished` of them, those that are more confident than the bar. Of those that meet the largest
/// packed number stays.
template <RaySampler S>
void propagation(const Band& band, const S& sampler, int ref, RowRange rows,
                 const std::vector<int>& active_views, const PropagationOptions& options,
                 MapView<const float> disparity, MapView<const float> confidence,
                 MapView<const Radiance> radiance, RowRange reached, int finished,
                 const StoredRows<float>& bars, const StoredRows<PackedEstimate>& estimates) {
  for_each_arrival(
      sampler, ref, rows, active_views, disparity, band.shape.height, reached,
      int(active_views.size()), [&](int u, int v, int target, int x, int y, float hypothesis) {
        const int view = active_views[target];
        const Radiance& mean = radiance.row(v)[u];
        if (view != ref && !(colour_distance(band.pixel(view, x, y), {mean.r, mean.g, mean.b}) <
                             options.tolerance))
          return;
        const float own = confidence.row(v)[u];
        if (target < finished && !(own > bars.at(y, target, x))) return;
        PackedEstimate& estimate = estimates.at(y, target, x);
        estimate = std::max(estimate, pack_estimate(hypothesis, own));
      });
}

/// Takes the bars away that set_bars made.
template <RaySampler S>
void clear_bars(const S& sampler, int ref, RowRange rows, const std::vector<int>& active_views,
                MapView<const float> disparity, int height, RowRange reached, int finished,
                const StoredRows<float>& bars) {
  for_each_arrival(sampler, ref, rows, active_views, disparity, height, reached, finished,
                   [&](int, int, int target, int x, int y, float) { bars.at(y, target, x) = 0; });
}

}  // namespace gigaray::reference
