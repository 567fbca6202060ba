// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// 4D: the ray of (u, v) in view `ref` is at (u + (s_ref - s) h, v + (t_ref - t) h) in view `other`
// (eq. 9). rays: ŝ - s, t̂ - t of every view times 2^-level. Twin of GridSampler.

static inline int locate(__global const float* rays, int other, float u, float v, float h,
                         float* u_other, float* v_other, float* h_other) {
  *u_other = u + rays[2 * other] * h;
  *v_other = v + rays[2 * other + 1] * h;
  *h_other = h;
  return 1;
}

// Where view `other` sees any block of the reference view under hypothesis h.
static inline BlockShift block_shift(__global const float* rays, int other, float h) {
  BlockShift shift;
  shift.whole_u = split_snapped(rays[2 * other] * h, &shift.fraction_u);
  shift.whole_v = split_snapped(rays[2 * other + 1] * h, &shift.fraction_v);
  return shift;
}
