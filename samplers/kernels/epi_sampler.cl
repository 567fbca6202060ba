// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// 3D: the ray of (u, v) in view `ref` is at (u + (s_ref - s) h, v) in view `other` (eq. 3).
// views: s of every view times 2^-level. Twin of EpiSampler.

static inline int locate(__global const float* views, int ref, int other, float u, float v, float h,
                  float* u_other, float* v_other, float* h_other) {
  *u_other = u + (views[ref] - views[other]) * h;
  *v_other = v;
  *h_other = h;
  return 1;
}

// What view `other` sees of LANES neighbouring pixels (u .. u + LANES - 1, v) of `ref`, all under
// hypothesis h. Returns 0 when it sees none of them.
static inline int sample_lanes(__global const float* band, const BandParams p,
                        __global const float* views, int ref, int other, int u, int v, float h,
                        vfloat* colour, vfloat* inside) {
  const float shift = snapped((views[ref] - views[other]) * h);
  const float whole = floor(shift);
  return sample_translated(band, p, other, u + (int)whole, shift - whole, v, 0.0f, colour, inside);
}
