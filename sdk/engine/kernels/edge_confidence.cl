// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Edge confidence Ce (eq. 2): the sum of colour distances between a pixel and its neighbours in a
// 1D window. Along u; with BOTH_AXES also along v, and the larger of the two counts.
//   confidence [row][pitch]
// One work-item per (block of LANES pixels, row). Neighbours outside the picture are left out.

#ifndef EDGE_RADIUS
#define EDGE_RADIUS 4  // half the window: 4 is the paper's 9 pixels
#endif
#ifndef SQUARED
#define SQUARED 1  // 1: squared distances, 0: plain ones
#endif
#ifndef BOTH_AXES
#define BOTH_AXES 0  // 1 for light fields that extend along t too
#endif

// 0 to a masked neighbour: the rim of a mask is no edge of the scene.
static inline vfloat colour_difference(__global const float* a, __global const float* b, int stride) {
  const vfloat sum = colour_distance2(a, b, stride);
  const vint at_rim = fabs(VLOAD(b) - 0.5f) > MASKED_BEYOND && fabs(VLOAD(a) - 0.5f) <= MASKED_BEYOND;
  return VSELECT(SQUARED ? sum : sqrt(sum), (vfloat)(0.0f), at_rim);
}

__kernel void edge_confidence(__global const float* band, const BandParams p, const StripParams strip,
                              __global float* confidence) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  // The padding repeats the edge pixel, which differs from the neighbours by something: left out.
  const vint x = u + VLANES;
  vfloat along_u = (vfloat)(0.0f);
  for (int k = -EDGE_RADIUS; k <= EDGE_RADIUS; ++k) {
    const vfloat d = colour_difference(here, here + k, p.stride);
    along_u += VSELECT((vfloat)(0.0f), d, x + k >= 0 && x + k < p.width);
  }
  vfloat along_v = (vfloat)(0.0f);
#if BOTH_AXES
  const int first = max(v - EDGE_RADIUS, 0), last = min(v + EDGE_RADIUS, p.height - 1);
  for (int y = first; y <= last; ++y)
    along_v += colour_difference(here, band_row(band, p, strip.ref, y) + u, p.stride);
#endif
  VSTORE(fmax(along_u, along_v), confidence + map_index(strip, row, u));
}
