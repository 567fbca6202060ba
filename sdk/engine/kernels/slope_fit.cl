// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Slope of the surface at a pixel: a robust plane through its estimate and those around it.
//   todo    [v][pitch] bytes; a block of LANES zeros is left out
//   in      [v][pitch] estimates; NaN: does not count
//   slopes  [v][pitch] (along u, along v), hypothesis units per px; 0 where nothing can be said
// One work-item per (block of LANES pixels, row). Weights: Gaussians of colour and distance, times
// Tukey's biweight of the residual, with ever smaller scale.

#define STRIDE 3  // px between the estimates that are looked at
#define SAMPLES 5  // of them on each side
#define REACH (STRIDE * SAMPLES)
#define SIGMA_COLOUR 0.05f
#define SIGMA_SPACE 8.0f  // px

__constant float RESIDUAL_SCALE[3] = {12.0f, 6.0f, 3.0f};  // hypotheses

__kernel void slope_fit(__global const float* band, const BandParams p, const StripParams strip,
                        __global const uchar* todo, __global const float* in, const float step,
                        const float max_slope,
                        __global float* slopes) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;
  int any_todo = 0;
  for (int lane = 0; lane < LANES && u + lane < strip.width; ++lane)
    any_todo |= todo[view_index(strip, row, u + lane)];
  if (!any_todo) return;
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  const vfloat own = VLOAD(in + view_index(strip, row, u));
  const vint x = u + VLANES;

  vfloat slope_u = (vfloat)(0.0f), slope_v = (vfloat)(0.0f);
  for (int round = 0; round < 3; ++round) {
    const float inverse_scale = 1.0f / (step * RESIDUAL_SCALE[round]);
    // Normal equations of two unknowns; a little weight on "no slope" keeps them solvable.
    vfloat uu = (vfloat)(1e-3f), uv = (vfloat)(0.0f), vv = uu, ud = uv, vd = uv;
    for (int j = -SAMPLES; j <= SAMPLES; ++j) {
      const int y = v + STRIDE * j;
      if (y < 0 || y >= p.height) continue;
      __global const float* there = band_row(band, p, strip.ref, y) + u;
      for (int i = -SAMPLES; i <= SAMPLES; ++i) {
        const float du = STRIDE * i, dv = STRIDE * j;
        const vfloat rise = VLOAD(in + view_index(strip, y - strip.row_begin, u) + STRIDE * i) - own;
        const vfloat residual = (rise - slope_u * du - slope_v * dv) * inverse_scale;
        const vfloat d2 = colour_distance2(there + STRIDE * i, here, p.stride);
        const float space = (du * du + dv * dv) / (2.0f * SIGMA_SPACE * SIGMA_SPACE);
        const vfloat biweight = max(1.0f - residual * residual, (vfloat)(0.0f));
        vfloat w = exp(-d2 / (2.0f * SIGMA_COLOUR * SIGMA_COLOUR) - space) * biweight * biweight;
        const vint counts =
            x + STRIDE * i >= 0 && x + STRIDE * i < p.width && rise == rise && biweight > 0.0f;
        w = VSELECT((vfloat)(0.0f), w, counts);
        const vfloat known_rise = VSELECT((vfloat)(0.0f), rise, counts);
        uu += w * du * du;
        uv += w * du * dv;
        vv += w * dv * dv;
        ud += w * du * known_rise;
        vd += w * dv * known_rise;
      }
    }
    const vfloat inverse = 1.0f / (uu * vv - uv * uv);
    slope_u = clamp((vv * ud - uv * vd) * inverse, (vfloat)(-max_slope), (vfloat)(max_slope));
    slope_v = clamp((uu * vd - uv * ud) * inverse, (vfloat)(-max_slope), (vfloat)(max_slope));
  }
  // Two values per pixel: (u, v) pairs.
  for (int lane = 0; lane < LANES && u + lane < strip.width; ++lane) {
    __global float* out = slopes + 2 * view_index(strip, row, u + lane);
#if LANES == 1
    out[0] = slope_u;
    out[1] = slope_v;
#else
    out[0] = ((const float*)&slope_u)[lane];
    out[1] = ((const float*)&slope_v)[lane];
#endif
  }
}
