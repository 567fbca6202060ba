// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Bilateral support: the score of a hypothesis at a pixel becomes the mean of the scores of its
// neighbours, weighed by colour (Gaussian, sigma_colour) and distance (Gaussian, sigma_space). With a
// slope, a neighbour counts with its score at the hypothesis that the surface through the pixel has
// there, linearly interpolated:
//   A(p, d) = sum_q w(p, q) S(q, d + slope · (q - p)) / sum_q w(p, q)
//   scores     [row - scores_begin][u][hypothesis]: the strip and SUPPORT_RADIUS rows on both sides, clipped to
//              the picture
//   slopes     [v][pitch] (along u, along v), hypothesis units per px
//   supported  [row][u][hypothesis]
//   todo, bounds as for density_score
// One work-item per pixel; lanes are hypotheses, VECTORS of them at a time.

#ifndef SUPPORT_RADIUS
#define SUPPORT_RADIUS 4
#endif
#ifndef VECTORS
#define VECTORS 1  // sums at a time, in registers: a single one would wait for each of its additions
#endif
#define INLINE static inline __attribute__((always_inline))
#define WINDOW (2 * SUPPORT_RADIUS + 1)
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
      const vint du = k - SUPPORT_RADIUS + VLANES;
      __global const float* there = band_row(band, p, strip.ref, y) + u - SUPPORT_RADIUS + k;
      vfloat d2 = (vfloat)(0.0f);
      UNROLL
      for (int c = 0; c < 3; ++c) {
        const vfloat d = VLOAD(there + c * p.stride) - here[c * p.stride];
        d2 += d * d;
      }
      const vfloat du_f = (vfloat)(k - SUPPORT_RADIUS) + LANE_NUMBERS;
      vfloat w = exp(-d2 * per_colour - (du_f * du_f + (float)((y - v) * (y - v))) * per_space);
      w = VSELECT((vfloat)(0.0f), w, du <= SUPPORT_RADIUS && u + du >= 0 && u + du < p.width);
      VSTORE(w, weights + (y - top) * WINDOW_PITCH + k);
      sum += w;
    }
  return sum_of_lanes(sum);
}

// The neighbours of pixel (u, v).
typedef struct {
  int top, bottom, left, right, u, v;
  float scale;
  const float* weights;
} Window;

INLINE const float* row_weights(const Window* window, int y) {
  return window->weights + (y - window->top) * WINDOW_PITCH + window->left - window->u + SUPPORT_RADIUS;
}

// Supported scores of neighbouring vectors. scores: the first of them at the window's first pixel.
INLINE void support_vectors(const Window* window, int width, int pitch,
                            __global const float* scores, int vectors, __global float* out) {
  vfloat totals[VECTORS];
  UNROLL
  for (int t = 0; t < VECTORS; ++t) totals[t] = (vfloat)(0.0f);
  for (int y = window->top; y <= window->bottom; ++y) {
    __global const float* from = scores + (size_t)(y - window->top) * width * pitch;
    const float* w = row_weights(window, y);
    for (int x = window->left; x <= window->right; ++x, from += pitch, ++w)
      UNROLL
      for (int t = 0; t < VECTORS; ++t)
        if (t < vectors) totals[t] += *w * VLOAD(from + t * LANES);
  }
  UNROLL
  for (int t = 0; t < VECTORS; ++t)
    if (t < vectors) VSTORE(totals[t] * window->scale, out + t * LANES);
}

__kernel void score_support(__global const float* band, const BandParams p, const StripParams strip,
                            const HypothesisParams hypotheses, __global const uchar* todo,
                            __global const ushort2* bounds, __global const float* scores,
                            const int scores_begin, const float sigma_colour,
                            const float sigma_space, __global float* supported) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width || !todo[view_index(strip, row, u)]) return;
  const ushort2 tested = bounds[view_index(strip, row, u)];
  const int top = max(v - SUPPORT_RADIUS, 0), bottom = min(v + SUPPORT_RADIUS, p.height - 1);
  const int left = max(u - SUPPORT_RADIUS, 0), right = min(u + SUPPORT_RADIUS, p.width - 1);
  float weights[WINDOW * WINDOW_PITCH];
  const float scale = 1.0f / support_weights(band, p, strip, u, v, top, bottom, sigma_colour,
                                             sigma_space, weights);

  const Window window = {top, bottom, left, right, u, v, scale, weights};
  __global const float* from = scores + score_index(strip, hypotheses, top - scores_begin, left);
  __global float* out = supported + score_index(strip, hypotheses, row, u);
  for (int i = lanes_floor(tested.x); i <= tested.y; i += VECTORS * LANES)
    support_vectors(&window, strip.width, hypotheses.pitch, from + i,
                    min(VECTORS, (tested.y - i) / LANES + 1), out + i);
  repeat_ends(out, hypotheses, tested.x, tested.y);
}

// The scores of hypotheses i, i + 1, … of a pixel; beyond the ends the last ones are repeated.
static inline vfloat scores_from(__global const float* column, int i, int count) {
#if LANES == 1
  return column[clamp(i, 0, count - 1)];
#else
  i = clamp(i, -LANES, count);
  const vint index = i + VLANES;
  vfloat value = VLOAD(column + i);
  value = VSELECT(value, (vfloat)(column[0]), index < 0);
  return VSELECT(value, (vfloat)(column[count - 1]), index >= count);
#endif
}

// By how many hypotheses the surface lies elsewhere at a neighbour; the rest, in [0, 1), to fraction.
// Without floor(), which is a call with branches on some CPUs.
INLINE int shift_at(float2 slope, int du, int dv, float* fraction) {
  const float shift = slope.x * (float)du + slope.y * (float)dv;
  int whole = (int)shift;
  whole -= shift < (float)whole;
  *fraction = shift - (float)whole;
  return whole;
}

// As support_vectors, of hypotheses i, i + 1, … scores: hypothesis 0. Shifts are from `least` to `most`.
INLINE void slanted_vectors(const Window* window, int width, int pitch, int count, float2 slope,
                            int least, int most, __global const float* scores, int i, int vectors,
                            __global float* out) {
  vfloat totals[VECTORS];
  int at_end[VECTORS];  // some of its neighbours' scores may be beyond the ends
  UNROLL
  for (int t = 0; t < VECTORS; ++t) {
    totals[t] = (vfloat)(0.0f);
    at_end[t] = i + t * LANES + least < 0 || i + (t + 1) * LANES + most + 1 > count;
  }
  for (int y = window->top; y <= window->bottom; ++y) {
    __global const float* column = scores + (size_t)(y - window->top) * width * pitch;
    const float* w = row_weights(window, y);
    for (int x = window->left; x <= window->right; ++x, column += pitch, ++w) {
      float fraction;
      const int from = i + shift_at(slope, x - window->u, y - window->v, &fraction);
      UNROLL
      for (int t = 0; t < VECTORS; ++t) {
        if (t >= vectors) continue;
        vfloat low, high;
        if (at_end[t]) {
          low = scores_from(column, from + t * LANES, count);
          high = scores_from(column, from + t * LANES + 1, count);
        } else {
          low = VLOAD(column + from + t * LANES);
          high = VLOAD(column + from + t * LANES + 1);
        }
        totals[t] += *w * (low + fraction * (high - low));
      }
    }
  }
  UNROLL
  for (int t = 0; t < VECTORS; ++t)
    if (t < vectors) VSTORE(totals[t] * window->scale, out + i + t * LANES);
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
  const int top = max(v - SUPPORT_RADIUS, 0), bottom = min(v + SUPPORT_RADIUS, p.height - 1);
  const int left = max(u - SUPPORT_RADIUS, 0), right = min(u + SUPPORT_RADIUS, p.width - 1);
  float weights[WINDOW * WINDOW_PITCH];
  const float scale = 1.0f / support_weights(band, p, strip, u, v, top, bottom, sigma_colour,
                                             sigma_space, weights);
  const float2 slope = vload2(view_index(strip, row, u), slopes) / hypotheses.step;

  const Window window = {top, bottom, left, right, u, v, scale, weights};
  int least = INT_MAX, most = INT_MIN;  // the corners have them
  for (int corner = 0; corner < 4; ++corner) {
    float fraction;
    const int whole = shift_at(slope, (corner & 1 ? right : left) - u,
                               (corner & 2 ? bottom : top) - v, &fraction);
    least = min(least, whole);
    most = max(most, whole);
  }
  __global const float* from = scores + score_index(strip, hypotheses, top - scores_begin, left);
  __global float* out = supported + score_index(strip, hypotheses, row, u);
  for (int i = lanes_floor(tested.x); i <= tested.y; i += VECTORS * LANES)
    slanted_vectors(&window, strip.width, hypotheses.pitch, hypotheses.count, slope, least, most,
                    from, i, min(VECTORS, (tested.y - i) / LANES + 1), out);
  repeat_ends(out, hypotheses, tested.x, tested.y);
}
