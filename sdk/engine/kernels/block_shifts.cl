// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Where every view sees a block of pixels of the reference view under every hypothesis: the same for
// all blocks, worked out once.
//   shifts  [hypothesis][view]
// One work-item per (view, hypothesis).

__kernel void block_shifts(__global const float* rays, const int num_views,
                           const HypothesisParams hypotheses, __global BlockShift* shifts) {
  const int k = get_global_id(0), i = get_global_id(1);
  shifts[i * num_views + k] = block_shift(rays, k, hypotheses.min + i * hypotheses.step);
}
