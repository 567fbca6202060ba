// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// One pyramid level down (section 4.5): 7 x 7 Gaussian of sigma sqrt(0.5), then every second pixel,
// so that pixel i stands for pixel 2 i. Edge pixels are repeated.
//   band   rows of the fine level
//   small  [v - stored_begin][stored view][3][small_width]; the views of the band are those from `first`
//          on, the work-items' rows begin at small_begin
// One work-item per (block of LANES small pixels, row of the small level, view).

__constant float GAUSSIAN[7] = {6.96193329e-05f, 1.03324251e-02f, 2.07532307e-01f,
                                5.64131298e-01f, 2.07532307e-01f, 1.03324251e-02f, 6.96193329e-05f};

// Vectors that hold the 2 LANES + 6 columns around a block of small pixels.
#define BLOCKS ((3 * LANES + 5) / LANES)

// Small pixel u: both sums, one pixel at a time.
static inline float smooth_pixel(__global const float* const* rows, int u) {
  float total = 0.0f;
  for (int y = 0; y < 7; ++y) {
    float sum = 0.0f;
    for (int x = 0; x < 7; ++x) sum += GAUSSIAN[x] * rows[y][2 * u + x - 3];
    total += GAUSSIAN[y] * sum;
  }
  return total;
}

__kernel void downsample(__global const float* band, const BandParams p, const int small_width,
                         const int small_begin, const int stored_begin, const int stored_views,
                         const int first, __global float* small) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1), view = get_global_id(2);
  if (u >= small_width) return;
  __global float* out = small + ((size_t)(small_begin + row - stored_begin) * stored_views +
                                         first + view) * 3 * small_width;
  for (int c = 0; c < 3; ++c) {
    __global const float* rows[7];
    for (int y = 0; y < 7; ++y) {
      const int v = clamp(2 * (small_begin + row) + y - 3, 0, p.height - 1);
      rows[y] = band_row(band, p, view, v) + c * p.stride;
    }
    __global float* here = out + c * small_width + u;
#if LANES > 1
    if (u + LANES <= small_width) {
      // Columns first, as vectors; then every second value along the row.
      float line[BLOCKS * LANES];
      for (int j = 0; j < BLOCKS; ++j) {
        vfloat column = (vfloat)(0.0f);
        for (int y = 0; y < 7; ++y)
          column += GAUSSIAN[y] * VLOAD(rows[y] + 2 * u - 3 + j * LANES);
        VSTORE(column, line + j * LANES);
      }
      vfloat total = (vfloat)(0.0f);
      for (int x = 0; x < 7; ++x)
        total += GAUSSIAN[x] * (vfloat)(VLOAD(line + x).even, VLOAD(line + x + LANES).even);
      VSTORE(total, here);
      continue;
    }
#endif
    for (int i = 0; i < LANES && u + i < small_width; ++i) here[i] = smooth_pixel(rows, u + i);
  }
}
