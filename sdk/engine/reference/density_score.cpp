// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "density_score.h"

namespace gigaray::reference {

float kernel(const Sample& sample, const Sample& centre, const ScoreOptions& options) {
  const float x = colour_distance(sample, centre) / options.bandwidth;
  if (!options.gradient) return std::max(1 - x * x, 0.0f);  // Epanechnikov
  const float k_colour = std::max(1 - x, 0.0f);
  const float gx = sample[3] - centre[3], gy = sample[4] - centre[4];
  const float k_gradient =
      std::max(1 - std::sqrt(gx * gx + gy * gy) / options.gradient_bandwidth, 0.0f);
  // The gate keeps an occluder of another colour from scoring by its gradient.
  return (1 - options.gradient_share) * k_colour +
         options.gradient_share * k_gradient * std::min(4 * k_colour, 1.0f);
}

Sample mean_shift(const std::vector<Sample>& samples, Sample start, const ScoreOptions& options,
                  int iterations) {
  ScoreOptions colour_only = options;
  colour_only.gradient = false;
  Sample mean = start;
  for (int i = 0; i < iterations; ++i) {
    float weights = 0;
    Sample sum{};
    for (const Sample& sample : samples) {
      const float x = colour_distance(sample, mean) / options.bandwidth;
      const float w =
          options.gradient ? std::max(1 - x, 0.0f) : kernel(sample, mean, colour_only);
      weights += w;
      for (int c = 0; c < 3; ++c) sum[c] += w * sample[c];
    }
    if (!(weights > 0)) break;
    for (int c = 0; c < 3; ++c) mean[c] = sum[c] / weights;
  }
  return mean;
}

}  // namespace gigaray::reference
