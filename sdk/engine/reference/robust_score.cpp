// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "robust_score.h"

namespace gigaray::reference {

float robust_kernel(const Sample& sample, const Sample& own, const ScoreOptions& options) {
  const float k_colour = colour_kernel(sample, own, options);
  const float gx = sample[3] - own[3], gy = sample[4] - own[4];
  const float k_gradient =
      std::max(1 - std::sqrt(gx * gx + gy * gy) / options.gradient_bandwidth, 0.0f);
  // The gate keeps an occluder of another colour from scoring by its gradient.
  return (1 - options.gradient_share) * k_colour +
         options.gradient_share * k_gradient * std::min(4 * k_colour, 1.0f);
}

}  // namespace gigaray::reference
