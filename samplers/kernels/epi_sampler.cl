// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// 3D: the ray of (u, v) in view `ref` is at (u + (s_ref - s) h, v) in view `other` (eq. 3).
// rays: ŝ - s of every view times 2^-level. Twin of EpiSampler.

static inline int locate(__global const float* rays, int other, float u, float v, float h,
                         float* u_other, float* v_other, float* h_other) {
  *u_other = u + rays[other] * h;
  *v_other = v;
  *h_other = h;
  return 1;
}

// Where view `other` sees any block of the reference view under hypothesis h.
static inline BlockShift block_shift(__global const float* rays, int other, float h) {
  BlockShift shift;
  shift.whole_u = split_snapped(rays[other] * h, &shift.fraction_u);
  shift.whole_v = 0;
  shift.fraction_v = 0.0f;
  return shift;
}
