// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <span>

#include "density_score.h"
#include "src/half_planes.h"

namespace gigaray::reference {

/// Triangle kernels of colour and gradient around `own`, 0 … 1 (docs/method.md).
float robust_kernel(const Sample& sample, const Sample& own, const ScoreOptions& options);

/// Score of one ray under one hypothesis: the mean of the kernels over the views; -1 when too few see
/// it. planes: empty, or for each view the half-planes that it lies in: then the best of their means.
template <RaySampler S>
float robust_score(const Band& band, const S& sampler, int ref, const Ray& ray,
                   const ScoreOptions& options, std::span<const std::uint8_t> planes) {
  const float all = float(sampler.num_views());
  const float least = std::max(1.0f, std::ceil(options.min_views * all));
  const float floor_views = (planes.empty() ? options.floor_views : kLeastHalfPlane) * all;
  const Sample own = band.pixel(ref, int(ray.u), int(ray.v));
  std::array<float, kHalfPlanes> sums{}, counts{};
  for (int other = 0; other < sampler.num_views(); ++other) {
    const auto there = sampler.locate(ref, other, ray);
    if (!there) continue;
    const auto sample = sample_at(band, other, there->u, there->v, options.cubic);
    if (!sample) continue;
    const float value = robust_kernel(*sample, own, options);
    for (int i = 0; i < kHalfPlanes; ++i) {
      const bool counts_here = planes.empty() ? i == 0 : (planes[other] >> i & 1) != 0;
      if (!counts_here) continue;
      sums[i] += value;
      counts[i] += 1;
    }
  }
  float best = -1;
  for (int i = 0; i < kHalfPlanes; ++i)
    if (counts[i] >= least) best = std::max(best, sums[i] / std::max(counts[i], floor_views));
  return best;
}

}  // namespace gigaray::reference
