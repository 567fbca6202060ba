// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Bilateral support: the score of a hypothesis at a pixel becomes the mean of the scores of its
// neighbours, weighed by colour (Gaussian, sigma_colour) and distance (Gaussian, sigma_space).
//   scores     [row - scores_begin][hypothesis][pitch], rows [scores_begin, scores_end): the strip and
//              RADIUS rows on both sides, clipped to the picture
//   supported  [row][hypothesis][pitch]
//   todo, bounds as for density_score
// One work-item per (block of LANES pixels, row); weights: (2 RADIUS + 1)^2 vectors of local memory.

#ifndef RADIUS
#define RADIUS 4
#endif
#define WINDOW (2 * RADIUS + 1)

__kernel void score_support(__global const float* band, const BandParams p, const StripParams strip,
                            const HypothesisParams hypotheses, __global const uchar* todo,
                            __global const ushort2* bounds, __global const float* scores,
                            const int scores_begin, const float sigma_colour,
                            const float sigma_space, __global float* supported,
                            __local vfloat* weights) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;

  const int2 tested = block_bounds(todo, bounds, strip, row, u);
  const int first = tested.x, last = tested.y;
  if (last < 0) return;

  const vint x = u + VLANES;
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  const int top = max(v - RADIUS, 0), bottom = min(v + RADIUS, p.height - 1);
  vfloat sum = (vfloat)(0.0f);
  for (int y = top; y <= bottom; ++y) {
    __global const float* there = band_row(band, p, strip.ref, y) + u;
    for (int k = -RADIUS; k <= RADIUS; ++k) {
      const vfloat d2 = colour_distance2(there + k, here, p.stride);
      const float space = ((y - v) * (y - v) + k * k) / (2.0f * sigma_space * sigma_space);
      vfloat w = exp(-d2 / (2.0f * sigma_colour * sigma_colour) - space);
      w = VSELECT((vfloat)(0.0f), w, x + k >= 0 && x + k < p.width);
      weights[SLICE((y - top) * WINDOW + k + RADIUS)] = w;
      sum += w;
    }
  }
  const vfloat scale = 1.0f / sum;

  for (int i = first; i <= last; ++i) {
    vfloat total = (vfloat)(0.0f);
    for (int y = top; y <= bottom; ++y) {
      __global const float* from =
          scores + score_index(strip, hypotheses.count, y - scores_begin, i, u);
      for (int k = 0; k < WINDOW; ++k) 
        total += weights[SLICE((y - top) * WINDOW + k)] * VLOAD(from + k - RADIUS);
    }
    VSTORE(total * scale, supported + score_index(strip, hypotheses.count, row, i, u));
  }
}
