// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "robust_score.h"

#include "kernels/kernel_params.h"

namespace gigaray::reference {

float robust_kernel(const Sample& sample, const Sample& own, const ScoreOptions& options) {
  const float steep = std::sqrt(own[3] * own[3] + own[4] * own[4]);
  const float distance =
      colour_distance(sample, own) / (options.bandwidth + options.colour_slack * steep);
  const float k_colour = (1 - TAIL_SHARE) * std::max(1 - distance, 0.0f) +
                         TAIL_SHARE * std::max(1 - distance / TAIL_WIDTH, 0.0f);
  const float gx = sample[3] - own[3], gy = sample[4] - own[4];
  const float k_gradient =
      std::max(1 - std::sqrt(gx * gx + gy * gy) /
                       (options.gradient_bandwidth + options.gradient_slack * steep),
               0.0f);
  // The gate keeps an occluder of another colour from scoring by its gradient.
  return (1 - options.gradient_share) * k_colour +
         options.gradient_share * k_gradient * std::min(4 * k_colour, 1.0f);
}

}  // namespace gigaray::reference
