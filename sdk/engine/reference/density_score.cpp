// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "density_score.h"

namespace gigaray::reference {

float colour_kernel(const Sample& sample, const Sample& centre, const ScoreOptions& options) {
  const float x = colour_distance(sample, centre) / options.bandwidth;
  return std::max(options.gradient ? 1 - x : 1 - x * x, 0.0f);
}

Sample mean_shift(const std::vector<Sample>& samples, Sample start, const ScoreOptions& options,
                  int iterations) {
  Sample mean = start;
  for (int i = 0; i < iterations; ++i) {
    float weights = 0;
    Sample sum{};
    for (const Sample& sample : samples) {
      const float w = colour_kernel(sample, mean, options);
      weights += w;
      for (int c = 0; c < 3; ++c) sum[c] += w * sample[c];
    }
    if (!(weights > 0)) break;
    for (int c = 0; c < 3; ++c) mean[c] = sum[c] / weights;
  }
  return mean;
}

}  // namespace gigaray::reference
