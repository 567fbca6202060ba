// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Bilateral median (eq. 8): the median of the estimates in a window, of pixels of a similar colour.
// Of an even number the lower of the two middle values: no depth that was never tested.
//   in   [v][pitch]; NaN: no estimate, does not count
//   out  [v][pitch]; NaN where `in` has none
// One work-item per (block of LANES pixels, row); window: (2 MEDIAN_RADIUS + 1)^2 vectors of local memory.

#ifndef MEDIAN_RADIUS
#define MEDIAN_RADIUS 5  // 5 is the paper's 11 x 11
#endif
#ifndef BILATERAL
#define BILATERAL 1  // 0: a plain median, colours are not looked at
#endif

// Unsigned integers in the order of the floats they stand for.
static inline vuint ordered(vint bits) { return VAS_UINT(bits ^ ((bits >> 31) | (vint)(0x80000000))); }

__kernel void bilateral_median(__global const float* band, const BandParams p,
                               const StripParams strip, __global const float* in,
                               const float tolerance, __global float* out,
                               __local vuint* window) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;
  __global const float* centre = in + view_index(strip, row, u);
  int any_estimate = 0;
  for (int lane = 0; lane < LANES && u + lane < p.width; ++lane)
    any_estimate |= !isnan(centre[lane]);
  __global float* result = out + view_index(strip, row, u);
  if (!any_estimate) {
    VSTORE((vfloat)(NAN), result);
    return;
  }

  // Collect the window: values as ordered integers, 0xffffffff for what does not count.
  const vint x = u + VLANES;
  const int top = max(v - MEDIAN_RADIUS, 0), bottom = min(v + MEDIAN_RADIUS, p.height - 1);
  int size = 0;
  vint count = (vint)(0);
  for (int y = top; y <= bottom; ++y) {
    __global const float* values = in + view_index(strip, y - strip.row_begin, u);
    for (int k = -MEDIAN_RADIUS; k <= MEDIAN_RADIUS; ++k) {
      const vfloat value = VLOAD(values + k);
      vint counts = x + k >= 0 && x + k < p.width && value == value;
#if BILATERAL
      __global const float* here = band_row(band, p, strip.ref, v) + u;
      __global const float* there = band_row(band, p, strip.ref, y) + u + k;
      const vfloat d2 = colour_distance2(there, here, p.stride);
      counts = counts && d2 < tolerance * tolerance;
#endif
      counts = VTRUE(counts);
      count -= counts;
      window[SLICE(size)] = VSELECT((vuint)(0xffffffffu), ordered(VAS_INT(value)), counts);
      ++size;
    }
  }

  // The rank-th smallest, bit by bit: the largest value that has fewer than rank values below it.
  const vint rank = (count + 1) / 2;
  vuint median = (vuint)(0);
  for (uint bit = 0x80000000u; bit != 0; bit >>= 1) {
    const vuint candidate = median | bit;
    vint below = (vint)(0);
    for (int i = 0; i < size; ++i) below -= VTRUE(window[SLICE(i)] < candidate);
    median = VSELECT(median, candidate, VTRUE(below < rank));
  }
  const vint bits = VAS_INT(median);
  const vint value = bits ^ ((~bits >> 31) | (vint)(0x80000000));
  const vfloat own = VLOAD(centre);
  VSTORE(VSELECT((vfloat)(NAN), VAS_FLOAT(value), VTRUE(own == own && count > 0)), result);
}
