// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/baselines/pair.h"

// One function per method; all_baselines() has them in this order.
namespace gigaray::baselines {

Baseline bm();
Baseline sgbm();
Baseline cost_volume();
Baseline graph_cut();
Baseline support_points();
Baseline edge_lines();
Baseline structure_tensor();
Baseline structure_tensor_labelled();

}  // namespace gigaray::baselines
