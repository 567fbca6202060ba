// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"
#include "kernels/kernel_params.h"

namespace gigaray::reference {

/// The two sides of a jump beside a pixel: estimates from `middle` on are of the nearer one.
struct Sides {
  float middle = kNoEstimate;
  float near = kNoEstimate, far = kNoEstimate;  ///< the nearest estimate of each
  int near_u = 0, near_v = 0, far_u = 0, far_v = 0;
};

/// Empty estimates where those within SIDE_WINDOW differ by no more than `jump`.
Sides sides_at(MapView<const float> disparity, int height, int u, int v, float jump);

/// Kernel of colour around `own`, wider than that of a score, of what a view shows along a ray.
template <RaySampler S>
std::optional<float> side_kernel(const Band& band, const S& sampler, int ref, int other,
                                 const Ray& ray, const Sample& own, const ScoreOptions& options) {
  const auto there = sampler.locate(ref, other, ray);
  const auto sample =
      there ? sample_at(band, other, there->u, there->v, options.cubic) : std::nullopt;
  if (!sample) return std::nullopt;
  const float distance = colour_distance(*sample, own) / (SIDE_WIDER * options.bandwidth);
  return std::max(1 - distance, 0.0f);
}

/// The pixel of the reference view whose point under hypothesis `near` view `other` sees where it
/// sees this one's under `far`, to first order. Empty: behind a camera, or seen as a point.
template <RaySampler S>
std::optional<std::pair<double, double>> pixel_before(const S& sampler, int ref, int other,
                                                      double u, double v, double near, double far) {
  const auto at = sampler.locate(ref, other, {u, v, near});
  const auto hidden = sampler.locate(ref, other, {u, v, far});
  const auto right = sampler.locate(ref, other, {u + 1, v, near});
  const auto down = sampler.locate(ref, other, {u, v + 1, near});
  if (!at || !hidden || !right || !down) return std::nullopt;
  const double a = right->u - at->u, b = down->u - at->u, c = right->v - at->v, d = down->v - at->v;
  const double x = hidden->u - at->u, y = hidden->v - at->v, area = a * d - b * c;
  if (!(std::abs(area) > SIDE_LEAST_AREA)) return std::nullopt;
  return std::pair(u + (d * x - b * y) / area, v + (a * y - c * x) / area);
}

/// How much more the rays of a pixel with colours `own` speak for the nearer side of a jump than
/// for the farther one; both have an estimate.
template <RaySampler S>
float side_evidence(const Band& band, const S& sampler, int ref, int u, int v, const Sides& sides,
                    const HypothesisRange& range, MapView<const float> disparity, const Sample& own,
                    const ScoreOptions& options) {
  // Estimates from other views may lie outside the range; rows are loaded for that.
  const double near = std::clamp<double>(sides.near, range.min, range.max),
               far = std::clamp<double>(sides.far, range.min, range.max);
  float near_sum = 0, near_count = 0, far_sum = 0, far_count = 0;
  for (int other = 0; other < sampler.num_views(); ++other) {
    if (other == ref) continue;
    const auto before = pixel_before(sampler, ref, other, u, v, near, far);
    if (!before) continue;
    if (const auto kernel =
            side_kernel(band, sampler, ref, other, Ray{double(u), double(v), near}, own, options)) {
      near_sum += *kernel;
      near_count += 1;
    }
    const auto kernel =
        side_kernel(band, sampler, ref, other, Ray{double(u), double(v), far}, own, options);
    if (!kernel) continue;
    const double du = before->first - u, dv = before->second - v;
    const double nearer = std::min(1.0, double(SIDE_VIEW_REACH) / std::abs(dv));
    const int before_u =
        int(std::nearbyint(std::clamp(u + nearer * du, 0.0, band.shape.width - 1.0)));
    const int before_v =
        int(std::nearbyint(std::clamp(v + nearer * dv, 0.0, band.shape.height - 1.0)));
    if (disparity.row(before_v)[before_u] >= sides.middle) continue;
    far_sum += *kernel;
    far_count += 1;
  }
  const float others = float(sampler.num_views() - 1);
  return near_sum / std::max(near_count, SIDE_NEAR_FLOOR * others) -
         far_sum / std::max(far_count, SIDE_FAR_FLOOR * others);
}

/// Pixels that belong to the other side take its nearest estimate; see jump_sides.cl. own: the
/// reference view `view` of a band.
void choose_sides(const Band& own, int view, RowRange rows, float jump, float sigma_colour,
                  MapView<const float> disparity, MapView<const float> confidence,
                  MapView<const float> evidence, MapView<float> chosen,
                  MapView<float> chosen_confidence);

}  // namespace gigaray::reference
