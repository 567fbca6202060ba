// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// One pyramid level down (section 4.5): 7 x 7 Gaussian of sigma sqrt(0.5), then every second pixel,
// so that pixel i stands for pixel 2 i. Edge pixels are repeated.
//   band   rows of the fine level
//   small  [row - small_begin][view][3][small_width], rows [small_begin, small_end)
// One work-item per (view, row of the small level).

__constant float GAUSSIAN[7] = {6.96193329e-05f, 1.03324251e-02f, 2.07532307e-01f,
                                5.64131298e-01f, 2.07532307e-01f, 1.03324251e-02f, 6.96193329e-05f};

__kernel void downsample(__global const float* band, const BandParams p, const int small_width,
                         const int small_begin, __global float* small) {
  const int view = get_global_id(0), row = get_global_id(1);
  const int v = 2 * (small_begin + row);
  __global float* out = small + ((size_t)row * p.num_views + view) * 3 * small_width;
  for (int c = 0; c < 3; ++c) {
    for (int u = 0; u < small_width; ++u) {
      float total = 0.0f;
      for (int y = -3; y <= 3; ++y) {
        __global const float* from =
            band_row(band, p, view, clamp(v + y, 0, p.height - 1)) + c * p.stride + 2 * u;
        float sum = 0.0f;
        for (int x = -3; x <= 3; ++x) sum += GAUSSIAN[x + 3] * from[x];
        total += GAUSSIAN[y + 3] * sum;
      }
      out[c * small_width + u] = total;
    }
  }
}
