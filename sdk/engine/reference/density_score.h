// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// Scores of a strip: [row][hypothesis][u]; -1 where too few views see the point.
struct Scores {
  RowRange rows;
  int count = 0;
  int width = 0;
  std::vector<float> data;

  Scores() = default;
  Scores(RowRange rows, int count, int width)
      : rows(rows),
        count(count),
        width(width),
        data(std::size_t(rows.size()) * count * width, -1) {}
  float& at(int u, int v, int i) {
    return data[(std::size_t(v - rows.begin) * count + i) * width + u];
  }
  /// Hypotheses that a pixel does not want tested get the score of the first or the last one that
  /// is: its neighbours may ask for them.
  void repeat_ends(int u, int v, HypothesisBounds tested) {
    for (int i = 0; i < tested.first; ++i) at(u, v, i) = at(u, v, tested.first);
    for (int i = tested.last + 1; i < count; ++i) at(u, v, i) = at(u, v, tested.last);
  }
  float at(int u, int v, int i) const { return const_cast<Scores*>(this)->at(u, v, i); }
};

/// Kernel of colour around `centre`, 0 … 1: Epanechnikov (eq. 4), or a triangle for the robust
/// score.
float colour_kernel(const Sample& sample, const Sample& centre, const ScoreOptions& options);

/// Mean radiance: `iterations` mean-shift updates from `start` (eq. 5).
Sample mean_shift(const std::vector<Sample>& samples, Sample start, const ScoreOptions& options,
                  int iterations);

/// What all views see of a ray (eq. 3, 9, 10); views that don't see it are left out.
template <RaySampler S>
std::vector<Sample> gather(const Band& band, const S& sampler, int ref, const Ray& ray,
                           bool cubic) {
  std::vector<Sample> samples;
  for (int other = 0; other < sampler.num_views(); ++other) {
    const auto there = sampler.locate(ref, other, ray);
    if (!there) continue;
    if (const auto sample = sample_at(band, other, there->u, there->v, cubic))
      samples.push_back(*sample);
  }
  return samples;
}

/// Score of one ray under one hypothesis (eq. 4); -1 when too few views see it.
template <RaySampler S>
float density_score(const Band& band, const S& sampler, int ref, const Ray& ray,
                    const ScoreOptions& options) {
  const auto samples = gather(band, sampler, ref, ray, options.cubic);
  const float all = float(sampler.num_views());
  if (float(samples.size()) < std::max(1.0f, std::ceil(options.min_views * all))) return -1;
  const Sample own = band.pixel(ref, int(ray.u), int(ray.v));
  const Sample centre = mean_shift(samples, own, options, options.mean_shift_iterations);
  float density = 0;
  for (const Sample& sample : samples) density += colour_kernel(sample, centre, options);
  return density / std::max(float(samples.size()), options.floor_views * all);
}

}  // namespace gigaray::reference
