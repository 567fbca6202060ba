// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Mean radiance (eq. 5) of accepted estimates: the colour that a tuple carries and that propagation
// compares with.
//   disparity  [row][pitch]; NaN: not accepted, nothing is written
//   radiance   [row][pitch][3]
// One work-item per pixel. Samples are linearly interpolated; ITERATIONS as in density_score, at
// least one.

#ifndef ITERATIONS
#define ITERATIONS 10
#endif
#ifndef GRADIENT
#define GRADIENT 0  // 1: triangle kernel of colour, 0: Epanechnikov kernel
#endif

__kernel void mean_radiance(__global const float* band, const BandParams p, const StripParams strip,
                            __global const float* views, __global const float* disparity,
                            const float bandwidth, __global float* radiance) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= p.width) return;
  const size_t pixel = map_index(strip, row, u);
  const float h = disparity[pixel];
  if (isnan(h)) return;
  const int v = strip.row_begin + row;

  float mean[3];
  __global const float* own = band_row(band, p, strip.ref, v) + u;
  for (int c = 0; c < 3; ++c) mean[c] = own[c * p.stride];
  for (int iteration = 0; iteration < max(ITERATIONS, 1); ++iteration) {
    float weights = 0.0f, sum[3] = {0.0f, 0.0f, 0.0f};
    for (int k = 0; k < p.num_views; ++k) {
      float x, y, h_other;
      if (!locate(views, strip.ref, k, u, v, h, &x, &y, &h_other)) continue;
      float fx, fy;
      const int xi = split_snapped(x, &fx), yi = split_snapped(y, &fy);
      if (xi < 0 || xi + (fx > 0.0f) > p.width - 1 || yi < 0 || yi + (fy > 0.0f) > p.height - 1)
        continue;
      __global const float* upper = band_row(band, p, k, yi) + xi;
      __global const float* lower = fy > 0.0f ? band_row(band, p, k, yi + 1) + xi : upper;
      float colour[3], d2 = 0.0f;
      for (int c = 0; c < 3; ++c) {
        const int o = c * p.stride;
        const float a = upper[o] + fx * (upper[o + 1] - upper[o]);
        const float b = lower[o] + fx * (lower[o + 1] - lower[o]);
        colour[c] = a + fy * (b - a);
        d2 += (colour[c] - mean[c]) * (colour[c] - mean[c]);
      }
      const float w = GRADIENT ? fmax(1.0f - sqrt(d2) / bandwidth, 0.0f)
                               : fmax(1.0f - d2 / (bandwidth * bandwidth), 0.0f);
      weights += w;
      for (int c = 0; c < 3; ++c) sum[c] += w * colour[c];
    }
    if (!(weights > 0.0f)) break;
    for (int c = 0; c < 3; ++c) mean[c] = sum[c] / weights;
  }
  for (int c = 0; c < 3; ++c) radiance[3 * pixel + c] = mean[c];
}
