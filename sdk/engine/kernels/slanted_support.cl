// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Bilateral support along the slope of the surface: like score_support, but a neighbour counts with
// its score at the hypothesis that the surface through the pixel has there, linearly interpolated:
//   A(p, d) = sum_q w(p, q) S(q, d + slope · (q - p)) / sum_q w(p, q)
//   scores     [row - scores_begin][hypothesis][pitch], the strip and RADIUS rows on both sides
//   slopes     [row][pitch] (along u, along v), hypothesis units per px
//   supported  [row][hypothesis][pitch]
// One work-item per (block of LANES pixels, row). Local memory: for each of the (2 RADIUS + 1)^2
// neighbours a vector of weights and one of shifts in hypotheses.

#ifndef RADIUS
#define RADIUS 4
#endif
#define WINDOW (2 * RADIUS + 1)

__kernel void slanted_support(__global const float* band, const BandParams p,
                              const StripParams strip, const HypothesisParams hypotheses,
                              __global const uchar* todo, __global const ushort2* bounds,
                              __global const float* slopes, __global const float* scores,
                              const int scores_begin, const float sigma_colour,
                              const float sigma_space, __global float* supported,
                              __local vfloat* neighbours) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;

  const int2 tested = block_bounds(todo, bounds, strip, row, u);
  const int first = tested.x, last = tested.y;
  if (last < 0) return;

  // Slopes of the pixels to do: elsewhere they may be anything.
  float pair[2][LANES];
  for (int lane = 0; lane < LANES; ++lane) {
    const size_t i = map_index(strip, row, u + lane);
    for (int c = 0; c < 2; ++c) pair[c][lane] = todo[i] ? slopes[2 * i + c] : 0.0f;
  }
  const vfloat slope_u = VLOAD(pair[0]), slope_v = VLOAD(pair[1]);

  const vint x = u + VLANES;
  const float per_step = 1.0f / hypotheses.step;
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
      sum += w;
      const int i = (y - top) * WINDOW + k + RADIUS;
      neighbours[SLICE(2 * i)] = w;
      neighbours[SLICE(2 * i + 1)] = (slope_u * (float)k + slope_v * (float)(y - v)) * per_step;
    }
  }
  const vfloat scale = 1.0f / sum;

  for (int i = first; i <= last; ++i) {
    vfloat total = (vfloat)(0.0f);
    for (int y = top; y <= bottom; ++y) {
      __global const float* from = scores + score_index(strip, hypotheses.count, y - scores_begin, 0, u);
      for (int k = 0; k < WINDOW; ++k) {
        const int neighbour = (y - top) * WINDOW + k;
        const vfloat at = clamp((float)i + neighbours[SLICE(2 * neighbour + 1)], (vfloat)(0.0f),
                                (vfloat)(hypotheses.count - 1));
        const vfloat whole = min(floor(at), (vfloat)(hypotheses.count - 2));
        const vfloat fraction = at - whole;
        vfloat low, high;
#if LANES == 1
        const size_t index = (size_t)whole * strip.pitch + k - RADIUS;
        low = from[index];
        high = from[index + strip.pitch];
#else
        for (int lane = 0; lane < LANES; ++lane) {
          const size_t index =
              (size_t)((const float*)&whole)[lane] * strip.pitch + k - RADIUS + lane;
          ((float*)&low)[lane] = from[index];
          ((float*)&high)[lane] = from[index + strip.pitch];
        }
#endif
        total += neighbours[SLICE(2 * neighbour)] * (low + fraction * (high - low));
      }
    }
    VSTORE(total * scale, supported + score_index(strip, hypotheses.count, row, i, u));
  }
}
