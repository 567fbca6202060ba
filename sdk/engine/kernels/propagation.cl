// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Propagation (section 4.4): an accepted estimate is written into every other view that sees its
// point in a similar colour. Where estimates meet the nearer one stays, then the more confident one:
// the result does not depend on the order. The first `finished` active views keep what they have
// unless what arrives is nearer and more confident by finished_lead (0: nearer is enough); pixels
// arrive there row by row, on every device.
//   active     [active_count] places in the band of the views that keep estimates; -1: not there
//   disparity  [row][pitch]; NaN: not accepted
//   confidence [row][pitch]; radiance [row][pitch][3]
//   estimates  [row - state_begin][active view][width] packed: ordered(hypothesis) << 32 | bits of
//              confidence; 0: none
// One work-item per active view: nobody else writes its estimates, so no atomics are needed.

static inline ulong packed_estimate(float h, float confidence) {
  const uint bits = as_uint(h);
  const uint key = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
  return (ulong)key << 32 | as_uint(fmax(confidence, 0.0f));
}

__kernel void propagation(__global const float* band, const BandParams p, const StripParams strip,
                          __global const float* rays, __global const int* active,
                          const int active_count, __global const float* disparity,
                          __global const float* confidence, __global const float* radiance,
                          const float tolerance, const int state_begin, const int state_end,
                          const int finished, const float finished_lead,
                          __global ulong* estimates) {
  const int target = get_global_id(0);
  const int view = active[target];
  if (view < 0) return;
  for (int v = strip.row_begin; v < strip.row_end; ++v) {
    for (int u = 0; u < p.width; ++u) {
      const size_t pixel = map_index(strip, v - strip.row_begin, u);
      const float h = disparity[pixel];
      if (isnan(h)) continue;
      float x = u, y = v, h_other = h;
      if (!locate(rays, view, u, v, h, &x, &y, &h_other)) continue;
      if (!(x > -0.5f && x < p.width - 0.5f && y > -0.5f && y < p.height - 0.5f)) continue;
      const int xi = min((int)floor(x + 0.5f), p.width - 1);
      const int yi = min((int)floor(y + 0.5f), p.height - 1);
      if (yi < state_begin || yi >= state_end) continue;
      if (view != strip.ref) {
        __global const float* there = band_row(band, p, view, yi) + xi;
        float d2 = 0.0f;
        for (int c = 0; c < 3; ++c) {
          const float d = there[c * p.stride] - radiance[3 * pixel + c];
          d2 += d * d;
        }
        if (!(d2 < tolerance * tolerance)) continue;
      }
      __global ulong* estimate =
          estimates + ((size_t)(yi - state_begin) * active_count + target) * p.width + xi;
      if (target < finished && *estimate != 0 && finished_lead > 0.0f &&
          !(confidence[pixel] > finished_lead * as_float((uint)*estimate)))
        continue;
      *estimate = max(*estimate, packed_estimate(h_other, confidence[pixel]));
    }
  }
}
