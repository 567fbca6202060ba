// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The reference view without its own noise: the colour of a pixel becomes the mean over the views along
// its ray, each weighed by the triangle kernel of its colour around the pixel's own.
//   band       [slot][view][CHANNELS][stride]
//   wanted     [v][pitch] bytes; 0: the pixel stays as it is
//   disparity  [v][pitch]; NaN: the same
//   means      [v][CHANNELS][stride], the layout of a band with one view; gradients are not written
// One work-item per pixel.

__kernel void ray_mean(__global const float* band, const BandParams p, const StripParams strip,
                       __global const float* rays, __global const uchar* wanted,
                       __global const float* disparity,
                       const float bandwidth, __global float* means) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  float own[3], sum[3], weights = 0.0f;
  for (int c = 0; c < 3; ++c) {
    own[c] = here[c * p.stride];
    sum[c] = 0.0f;
  }
  const size_t pixel = view_index(strip, row, u);
  const float d = disparity[pixel];
  const int num_views = isnan(d) || !wanted[pixel] ? 0 : p.num_views;
  for (int k = 0; k < num_views; ++k) {
    float x, y, d_other, sample[3], d2 = 0.0f;
    if (!locate(rays, k, u, v, d, &x, &y, &d_other) || !sample_pixel(band, p, k, x, y, sample)) continue;
    UNROLL
    for (int c = 0; c < 3; ++c) d2 += (sample[c] - own[c]) * (sample[c] - own[c]);
    const float w = max(1.0f - sqrt(d2) / bandwidth, 0.0f);
    weights += w;
    UNROLL
    for (int c = 0; c < 3; ++c) sum[c] += w * sample[c];
  }
  __global float* out = means + (size_t)v * CHANNELS * p.stride + GIGARAY_PAD + u;
  UNROLL
  for (int c = 0; c < 3; ++c) out[c * p.stride] = weights > 0.0f ? sum[c] / weights : own[c];
}
