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

// What view `other` sees of LANES neighbouring pixels (u .. u + LANES - 1, v) of `ref`, all under
// hypothesis h. Returns 0 when it sees none of them.
static inline int sample_lanes(__global const float* band, const BandParams p,
                        __global const float* views, int ref, int other, int u, int v, float h,
                        vfloat* colour, vfloat* inside) {
  const float shift_u = snapped((views[2 * ref] - views[2 * other]) * h);
  const float shift_v = snapped((views[2 * ref + 1] - views[2 * other + 1]) * h);
  const float whole_u = floor(shift_u), whole_v = floor(shift_v);
  return sample_translated(band, p, other, u + (int)whole_u, shift_u - whole_u, v + (int)whole_v,
                           shift_v - whole_v, colour, inside);
}
