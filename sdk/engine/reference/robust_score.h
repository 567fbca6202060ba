// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "density_score.h"
#include "kernels/kernel_params.h"
#include "src/view_sets.h"

namespace gigaray::reference {

/// Kernels of colour, a triangle with a tail, and of gradient around `own`, 0 … 1 (docs/method.md).
float robust_kernel(const Sample& sample, const Sample& own, const ScoreOptions& options);

/// A sample of view `other` with its gradient as the pixels of `ref` see it: turned and scaled by
/// how the place in `other` changes with the pixel.
template <RaySampler S>
Sample seen_from(const S& sampler, int ref, int other, const Ray& ray, Sample sample) {
  if constexpr (!S::kRaysShiftAlike) {
    const auto along = [&](double du, double dv) {
      const Ray before{ray.u - du, ray.v - dv, ray.hypothesis},
          after{ray.u + du, ray.v + dv, ray.hypothesis};
      const auto a = sampler.locate(ref, other, before), b = sampler.locate(ref, other, after);
      if (!a || !b) return 0.0f;
      return float((b->u - a->u) * sample[3] + (b->v - a->v) * sample[4]);
    };
    const float gx = along(0.5, 0), gy = along(0, 0.5);
    sample[3] = gx;
    sample[4] = gy;
  }
  return sample;
}

/// Score of a ray with colours `own` under one hypothesis: the mean of the kernels over the views;
/// those that are missing to ScoreOptions::floor_views say ScoreOptions::unseen. -1 when too few
/// see it. parts 1: over the views with bit 0 of their `members`. parts 8: the best of the means
/// over half-plane i, the views with bit i.
template <RaySampler S>
float robust_score(const Band& band, const S& sampler, int ref, const Ray& ray, const Sample& own,
                   const ScoreOptions& options, std::span<const std::uint8_t> members, int parts) {
  const auto used =
      std::count_if(members.begin(), members.end(), [](auto bits) { return bits != 0; });
  const float least = std::ceil(options.min_views * float(used));
  const float share = parts == 1 ? options.floor_views : kLeastHalfPlane;
  const float floor_views = std::max(share * float(used), kLeastFloor);
  const float unseen = parts == 1 ? options.unseen : 0;
  std::array<float, kHalfPlanes> sums{}, counts{};
  for (int other = 0; other < sampler.num_views(); ++other) {
    if (members[other] == 0) continue;
    const auto there = sampler.locate(ref, other, ray);
    if (!there) continue;
    const auto sample = sample_at(band, other, there->u, there->v, options.cubic);
    if (!sample) continue;
    const float value = robust_kernel(seen_from(sampler, ref, other, ray, *sample), own, options);
    for (int i = 0; i < parts; ++i) {
      if (!(members[other] >> i & 1)) continue;
      sums[i] += value;
      counts[i] += 1;
    }
  }
  float best = -1;
  for (int i = 0; i < parts; ++i)
    if (counts[i] >= least)
      best = std::max(best, (sums[i] + unseen * std::max(floor_views - counts[i], 0.0f)) /
                                std::max(counts[i], floor_views));
  return best;
}

}  // namespace gigaray::reference
