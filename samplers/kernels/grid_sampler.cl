// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// 4D: the ray of (u, v) in view `ref` is at (u + (s_ref - s) h, v + (t_ref - t) h) in view `other`
// (eq. 9). views: s, t of every view times 2^-level. Twin of GridSampler.

static inline int locate(__global const float* views, int ref, int other, float u, float v, float h,
                  float* u_other, float* v_other, float* h_other) {
  *u_other = u + (views[2 * ref] - views[2 * other]) * h;
  *v_other = v + (views[2 * ref + 1] - views[2 * other + 1]) * h;
  *h_other = h;
  return 1;
}

// Where view `other` sees any block of `ref` under hypothesis h.
static inline BlockShift block_shift(__global const float* views, int ref, int other, float h) {
  BlockShift shift;
  shift.whole_u =
      split_snapped((views[2 * ref] - views[2 * other]) * h, &shift.fraction_u);
  shift.whole_v =
      split_snapped((views[2 * ref + 1] - views[2 * other + 1]) * h, &shift.fraction_v);
  return shift;
}
