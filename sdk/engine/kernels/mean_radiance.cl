// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Mean radiance (eq. 5) of accepted estimates: the colour that a tuple carries and that propagation
// compares with.
//   disparity  [v][pitch]; NaN: not accepted, nothing is written
//   radiance   [v][pitch][3]
//   staged     local memory, 3 vectors per view: the samples, see density_score (STAGE 1)
// One work-item per (block of LANES pixels, row). Samples are linearly interpolated; ITERATIONS as in
// density_score, at least one.

#ifndef ITERATIONS
#define ITERATIONS 10
#endif
#ifndef GRADIENT
#define GRADIENT 0  // 1: triangle kernel of colour, 0: Epanechnikov kernel
#endif
#ifndef STAGE
#define STAGE 1
#endif

// A colour that no kernel reaches stands for "not inside the picture".
#define NOT_SEEN 1e4f

// Linear interpolation of RGB.
static inline void sample_colour(__global const float* band, const BandParams p, int k, int x, int y,
                                 float fx, float fy, float* sample) {
  __global const float* upper = band_row(band, p, k, y) + x;
  __global const float* lower = fy > 0.0f ? band_row(band, p, k, y + 1) + x : upper;
  for (int c = 0; c < 3; ++c) {
    const int o = c * p.stride;
    const float a = upper[o] + fx * (upper[o + 1] - upper[o]);
    const float b = lower[o] + fx * (lower[o + 1] - lower[o]);
    sample[c] = a + fy * (b - a);
  }
}

// What view k sees of each pixel (u + lane, v) under its own hypothesis.
static inline void sample_pixels(__global const float* band, const BandParams p,
                                 __global const float* rays, int k, int u, int v, const float* h,
                                 vfloat* colour) {
  float values[3][LANES];
  for (int lane = 0; lane < LANES; ++lane) {
    for (int c = 0; c < 3; ++c) values[c][lane] = NOT_SEEN;
    float x, y, h_other, fx, fy;
    if (isnan(h[lane]) || !locate(rays, k, u + lane, v, h[lane], &x, &y, &h_other)) continue;
    const int xi = split_snapped(x, &fx), yi = split_snapped(y, &fy);
    if (xi < 0 || xi + (fx > 0.0f) > p.width - 1 || yi < 0 || yi + (fy > 0.0f) > p.height - 1)
      continue;
    float sample[3];
    sample_colour(band, p, k, xi, yi, fx, fy, sample);
    if (fabs(sample[0] - 0.5f) > MASKED_BEYOND) continue;
    for (int c = 0; c < 3; ++c) values[c][lane] = sample[c];
  }
  for (int c = 0; c < 3; ++c) colour[c] = VLOAD(values[c]);
}

__kernel void mean_radiance(__global const float* band, const BandParams p, const StripParams strip,
                            __global const float* rays, __global const float* disparity,
                            const float bandwidth, __global float* radiance,
                            __local vfloat* staged) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= p.width) return;
  const int v = strip.row_begin + row;
  float h[LANES];
  int any_estimate = 0;
  for (int lane = 0; lane < LANES; ++lane) {
    h[lane] = u + lane < p.width ? disparity[view_index(strip, row, u + lane)] : NAN;
    any_estimate |= !isnan(h[lane]);
  }
  if (!any_estimate) return;

  vfloat mean[3], colour[3];
  __global const float* own = band_row(band, p, strip.ref, v) + u;
  for (int c = 0; c < 3; ++c) mean[c] = VLOAD(own + c * p.stride);
#if STAGE
  for (int k = 0; k < p.num_views; ++k) {
    sample_pixels(band, p, rays, k, u, v, h, colour);
    for (int c = 0; c < 3; ++c) staged[SLICE(3 * k + c)] = colour[c];
  }
#endif
  for (int iteration = 0; iteration < max(ITERATIONS, 1); ++iteration) {
    vfloat weights = (vfloat)(0.0f), sum[3] = {0.0f, 0.0f, 0.0f};
    for (int k = 0; k < p.num_views; ++k) {
#if STAGE
      UNROLL
      for (int c = 0; c < 3; ++c) colour[c] = staged[SLICE(3 * k + c)];
#else
      sample_pixels(band, p, rays, k, u, v, h, colour);
#endif
      const vfloat r = colour[0] - mean[0], g = colour[1] - mean[1], b = colour[2] - mean[2];
      const vfloat d2 = r * r + g * g + b * b;
      const vfloat w = GRADIENT ? max(1.0f - sqrt(d2) / bandwidth, (vfloat)(0.0f))
                                : max(1.0f - d2 / (bandwidth * bandwidth), (vfloat)(0.0f));
      weights += w;
      UNROLL
      for (int c = 0; c < 3; ++c) sum[c] += w * colour[c];
    }
    // Where no sample is near, the mean stays.
    const vfloat scale = 1.0f / max(weights, (vfloat)(1e-12f));
    UNROLL
    for (int c = 0; c < 3; ++c) mean[c] = VSELECT(mean[c], sum[c] * scale, weights > 0.0f);
  }
  float values[3][LANES];
  for (int c = 0; c < 3; ++c) VSTORE(mean[c], values[c]);
  for (int lane = 0; lane < LANES; ++lane)
    if (!isnan(h[lane]))
      for (int c = 0; c < 3; ++c)
        radiance[3 * view_index(strip, row, u + lane) + c] = values[c][lane];
}
