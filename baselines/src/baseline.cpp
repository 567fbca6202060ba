// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/baseline.h"

#include "gigaray/baselines/methods.h"

namespace gigaray::baselines {

const std::vector<Baseline>& all_baselines() {
  static const std::vector<Baseline> all{bm(),
                                         sgbm(),
                                         cost_volume(),
                                         graph_cut(),
                                         support_points(),
                                         edge_lines(),
                                         structure_tensor(),
                                         structure_tensor_labelled()};
  return all;
}

}  // namespace gigaray::baselines
