// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Propagation (section 4.4): an accepted estimate is written into every other view that sees its
// point in a similar colour. Where estimates meet the nearer one stays, then the more confident one. A
// view that is finished takes in only what is more confident than its bar, which it got from its own
// estimate then: every arrival is judged alone, so the result has no order.
//   active     [active_count] places in the band of the views that keep estimates; -1: not there
//   disparity  [row][pitch]; NaN: not accepted
//   confidence [row][pitch]; radiance [row][pitch][3]
//   bars       [row - state_begin][active view][width], see raise_bars; read with GUARDED 1 alone
//   estimates  [row - state_begin][active view][width] packed: ordered(hypothesis) << 32 | bits of
//              confidence; 0: none
// ATOMIC 1: one work-item per (pixel, row). ATOMIC 0, for devices without 64-bit atomics: one per
// active view, whose estimates nobody else writes.

#ifndef ATOMIC
#define ATOMIC 0
#endif
#ifndef GUARDED
#define GUARDED 0
#endif
#if ATOMIC
#pragma OPENCL EXTENSION cl_khr_int64_extended_atomics : enable
#endif

static inline ulong packed_estimate(float h, float confidence) {
  const uint bits = as_uint(h);
  const uint key = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
  return (ulong)key << 32 | as_uint(fmax(confidence, 0.0f));
}

static inline void propagate_pixel(__global const float* band, const BandParams p,
                                   const StripParams strip, __global const float* rays, int view,
                                   int target, int active_count, int u, int v, float h,
                                   float confidence, __global const float* radiance,
                                   float tolerance, int state_begin, int state_end,
                                   __global const float* bars, volatile __global ulong* estimates) {
  float x = u, y = v, h_other = h;
  if (!locate(rays, view, u, v, h, &x, &y, &h_other)) return;
  if (!(x > -0.5f && x < p.width - 0.5f && y > -0.5f && y < p.height - 0.5f)) return;
  const int xi = min((int)floor(x + 0.5f), p.width - 1);
  const int yi = min((int)floor(y + 0.5f), p.height - 1);
  if (yi < state_begin || yi >= state_end) return;
  if (view != strip.ref) {
    __global const float* there = band_row(band, p, view, yi) + xi;
    float d2 = 0.0f;
    for (int c = 0; c < 3; ++c) {
      const float d = there[c * p.stride] - radiance[c];
      d2 += d * d;
    }
    if (!(d2 < tolerance * tolerance)) return;
  }
  const size_t at = ((size_t)(yi - state_begin) * active_count + target) * p.width + xi;
#if GUARDED
  if (bars[at] > 0.0f && !(confidence > bars[at])) return;
#endif
  const ulong arrival = packed_estimate(h_other, confidence);
#if ATOMIC
  if (arrival > estimates[at]) atom_max(estimates + at, arrival);
#else
  if (arrival > estimates[at]) estimates[at] = arrival;
#endif
}

__kernel void propagation(__global const float* band, const BandParams p, const StripParams strip,
                          __global const float* rays, __global const int* active,
                          const int active_count, __global const float* disparity,
                          __global const float* confidence, __global const float* radiance,
                          const float tolerance, const int state_begin, const int state_end,
                          __global const float* bars, __global ulong* estimates) {
#if ATOMIC
  const int u = get_global_id(0), row = get_global_id(1);
  const size_t pixel = map_index(strip, row, u);
  const float h = disparity[pixel];
  if (isnan(h)) return;
  for (int target = 0; target < active_count; ++target)
    if (active[target] >= 0)
      propagate_pixel(band, p, strip, rays, active[target], target, active_count, u,
                      strip.row_begin + row, h, confidence[pixel], radiance + 3 * pixel, tolerance,
                      state_begin, state_end, bars, estimates);
#else
  const int target = get_global_id(0);
  if (active[target] < 0) return;
  for (int row = 0; row < strip.row_end - strip.row_begin; ++row)
    for (int u = 0; u < p.width; ++u) {
      const size_t pixel = map_index(strip, row, u);
      const float h = disparity[pixel];
      if (isnan(h)) continue;
      propagate_pixel(band, p, strip, rays, active[target], target, active_count, u,
                      strip.row_begin + row, h, confidence[pixel], radiance + 3 * pixel, tolerance,
                      state_begin, state_end, bars, estimates);
    }
#endif
}
