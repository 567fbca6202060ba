// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Bilateral support: the score of a hypothesis at a pixel becomes the mean of the scores of its
// neighbours, weighed by colour (Gaussian, sigma_colour) and distance (Gaussian, sigma_space). With a
// slope, a neighbour counts with its score at the hypothesis that the surface through the pixel has
// there, linearly interpolated:
//   A(p, d) = sum_q w(p, q) S(q, d + slope · (q - p)) / sum_q w(p, q)
//   scores     [row - scores_begin][u][hypothesis]: the strip and RADIUS rows on both sides, clipped to
//              the picture
//   slopes     [v][pitch] (along u, along v), hypothesis units per px
//   supported  [row][u][hypothesis]
//   todo, bounds as for density_score
// One work-item per pixel; lanes are hypotheses.

#ifndef RADIUS
#define RADIUS 4
#endif
#define WINDOW (2 * RADIUS + 1)
#define WINDOW_PITCH ((WINDOW + LANES - 1) / LANES * LANES)

// Weights of the neighbours, [row][WINDOW_PITCH]; 0 outside the picture. Returns their sum.
static inline float support_weights(__global const float* band, const BandParams p,
                                    const StripParams strip, int u, int v, int top, int bottom,
                                    float sigma_colour, float sigma_space, float* weights) {
  const float per_colour = 1.0f / (2.0f * sigma_colour * sigma_colour);
  const float per_space = 1.0f / (2.0f * sigma_space * sigma_space);
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  vfloat sum = (vfloat)(0.0f);
  for (int y = top; y <= bottom; ++y)
    for (int k = 0; k < WINDOW; k += LANES) {
      const vint du = k - RADIUS + VLANES;
      __global const float* there = band_row(band, p, strip.ref, y) + u - RADIUS + k;
      vfloat d2 = (vfloat)(0.0f);
      UNROLL
      for (int c = 0; c < 3; ++c) {
        const vfloat d = VLOAD(there + c * p.stride) - here[c * p.stride];
        d2 += d * d;
      }
      const vfloat du_f = (vfloat)(k - RADIUS) + LANE_NUMBERS;
      vfloat w = exp(-d2 * per_colour - (du_f * du_f + (float)((y - v) * (y - v))) * per_space);
      w = VSELECT((vfloat)(0.0f), w, du <= RADIUS && u + du >= 0 && u + du < p.width);
      VSTORE(w, weights + (y - top) * WINDOW_PITCH + k);
      sum += w;
    }
  return sum_of_lanes(sum);
}

__kernel void score_support(__global const float* band, const BandParams p, const StripParams strip,
                            const HypothesisParams hypotheses, __global const uchar* todo,
                            __global const ushort2* bounds, __global const float* scores,
                            const int scores_begin, const float sigma_colour,
                            const float sigma_space, __global float* supported) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width || !todo[view_index(strip, row, u)]) return;
  const ushort2 tested = bounds[view_index(strip, row, u)];
  const int top = max(v - RADIUS, 0), bottom = min(v + RADIUS, p.height - 1);
  const int left = max(u - RADIUS, 0), right = min(u + RADIUS, p.width - 1);
  float weights[WINDOW * WINDOW_PITCH];
  const float scale = 1.0f / support_weights(band, p, strip, u, v, top, bottom, sigma_colour,
                                             sigma_space, weights);

  __global float* out = supported + score_index(strip, hypotheses, row, u);
  for (int i = lanes_floor(tested.x); i <= tested.y; i += LANES) {
    vfloat total = (vfloat)(0.0f);
    for (int y = top; y <= bottom; ++y) {
      __global const float* from = scores + score_index(strip, hypotheses, y - scores_begin, left) + i;
      const float* w = weights + (y - top) * WINDOW_PITCH + left - u + RADIUS;
      for (int x = left; x <= right; ++x, from += hypotheses.pitch) total += *w++ * VLOAD(from);
    }
    VSTORE(total * scale, out + i);
  }
  repeat_ends(out, hypotheses, tested.x, tested.y);
}

// The scores of hypotheses i, i + 1, … of a pixel; beyond the ends the last ones are repeated.
static inline vfloat scores_from(__global const float* column, int i, int count) {
  if (i >= 0 && i + LANES <= count) return VLOAD(column + i);
  if (i >= count) return (vfloat)(column[count - 1]);
  if (i + LANES <= 0) return (vfloat)(column[0]);
#if LANES == 1
  return column[0];
#else
  const vint index = i + VLANES;
  vfloat value = VLOAD(column + i);
  value = VSELECT(value, (vfloat)(column[0]), index < 0);
  return VSELECT(value, (vfloat)(column[count - 1]), index >= count);
#endif
}

__kernel void slanted_support(__global const float* band, const BandParams p,
                              const StripParams strip, const HypothesisParams hypotheses,
                              __global const uchar* todo, __global const ushort2* bounds,
                              __global const float* slopes, __global const float* scores,
                              const int scores_begin, const float sigma_colour,
                              const float sigma_space, __global float* supported) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width || !todo[view_index(strip, row, u)]) return;
  const ushort2 tested = bounds[view_index(strip, row, u)];
  const int top = max(v - RADIUS, 0), bottom = min(v + RADIUS, p.height - 1);
  const int left = max(u - RADIUS, 0), right = min(u + RADIUS, p.width - 1);
  float weights[WINDOW * WINDOW_PITCH];
  const float scale = 1.0f / support_weights(band, p, strip, u, v, top, bottom, sigma_colour,
                                             sigma_space, weights);
  const float2 slope = vload2(view_index(strip, row, u), slopes) / hypotheses.step;

  __global float* out = supported + score_index(strip, hypotheses, row, u);
  for (int i = lanes_floor(tested.x); i <= tested.y; i += LANES) {
    vfloat total = (vfloat)(0.0f);
    for (int y = top; y <= bottom; ++y) {
      __global const float* column = scores + score_index(strip, hypotheses, y - scores_begin, left);
      const float* w = weights + (y - top) * WINDOW_PITCH + left - u + RADIUS;
      for (int x = left; x <= right; ++x, column += hypotheses.pitch, ++w) {
        const float shift = slope.x * (float)(x - u) + slope.y * (float)(y - v);
        const int whole = (int)floor(shift);
        const float fraction = shift - (float)whole;
        const vfloat low = scores_from(column, i + whole, hypotheses.count);
        const vfloat high = scores_from(column, i + whole + 1, hypotheses.count);
        total += *w * (low + fraction * (high - low));
      }
    }
    VSTORE(total * scale, out + i);
  }
  repeat_ends(out, hypotheses, tested.x, tested.y);
}
