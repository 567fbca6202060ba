// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Scan-line step: along a path of neighbouring pixels a hypothesis may change, at a price (Hirschmüller
// 2008, in the form of a maximum, with a linear price for small changes):
//   Q(p, d) = S(p, d) + max(P(d), P(d ± 1) - small / 2, P(d ± 2) - small, max P - jump) - max P
// with P = Q of the pixel before and jump lower where the colour changes. Rows are followed from end to
// end; columns from SCANLINE_REACH rows before the block of SCANLINE_BLOCK rows, so that an answer
// depends on rows nearby only. A path begins anew after a pixel that is not to do.
//   scores      [row - scores_begin][u][hypothesis], the strip and SCANLINE_REACH rows on both sides,
//               clipped to the picture
//   todo        [v][pitch]
//   aggregated  [row - scores_begin][u][hypothesis], rows of the strip: set by the first direction,
//               others add to it (`add`)
//   states      local memory, 2 (pitch + 2 MARGIN) floats
// Direction (du, dv): one of them is 0, the other ±1. strip.row_begin is a multiple of SCANLINE_BLOCK.
// One work-group of GROUP work-items, which share the hypotheses, per row, or per (column, block).

#define MARGIN 16  // floats beside the states, no hypothesis
#define NOTHING -1e9f

#if GROUP > 1
#define MEET barrier(CLK_LOCAL_MEM_FENCE)
#else
#define MEET
#endif

// The largest value of all work-items of the group.
static inline float largest_of_group(float own, __local float* shared) {
#if GROUP == 1
  return own;
#else
  shared[get_local_id(0)] = own;
  MEET;
  float largest = shared[0];
  for (int i = 1; i < GROUP; ++i) largest = max(largest, shared[i]);
  MEET;
  return largest;
#endif
}

__kernel void scanline(__global const float* band, const BandParams p, const StripParams strip,
                       const HypothesisParams hypotheses, __global const uchar* todo,
                       __global const float* scores, const int scores_begin, const int du,
                       const int dv, const float small, const float jump, const float sigma_colour,
                       const int add, __global float* aggregated, __local float* states) {
  const int path = get_group_id(0), lane = get_local_id(0) * LANES;
  int u, v, end_u, end_v;               // first pixel of the path, and beyond the last
  int keep_begin = 0, keep_end = p.height;  // rows whose answer is kept
  if (dv == 0) {
    v = end_v = strip.row_begin + path;
    u = du > 0 ? 0 : strip.width - 1;
    end_u = du > 0 ? strip.width : -1;
  } else {
    u = end_u = path;
    keep_begin = strip.row_begin + get_group_id(1) * SCANLINE_BLOCK;
    keep_end = min(keep_begin + SCANLINE_BLOCK, strip.row_end);
    const int top = max(keep_begin - SCANLINE_REACH, 0);
    const int bottom = min(keep_end + SCANLINE_REACH, p.height);
    v = dv > 0 ? top : bottom - 1;
    end_v = dv > 0 ? bottom : top - 1;
  }

  const int length = hypotheses.pitch + 2 * MARGIN;
  __local float* before = states + MARGIN;
  __local float* now = before + length;
  __local float* shared = states + 2 * length;
  for (int i = get_local_id(0); i < 2 * length; i += GROUP) states[i] = NOTHING;
  MEET;

  float best_before = 0.0f;
  int begins = 1;
  for (; u != end_u || v != end_v; u += du, v += dv) {
    if (!todo[view_index(strip, v - strip.row_begin, u)]) {
      begins = 1;
      continue;
    }
    const size_t at = score_index(strip, hypotheses, v - scores_begin, u);
    float price = 0.0f;
    if (!begins) {
      __global const float* here = band_row(band, p, strip.ref, v) + u;
      __global const float* there = band_row(band, p, strip.ref, v - dv) + u - du;
      float d2 = 0.0f;
      UNROLL
      for (int c = 0; c < 3; ++c) {
        const float d = here[c * p.stride] - there[c * p.stride];
        d2 += d * d;
      }
      price = max(jump * exp(-sqrt(d2) / sigma_colour), 0.5f * small);
    }
    const float two_steps = min(small, price), one_step = 0.5f * two_steps;
    const int keep = v >= keep_begin && v < keep_end;
    vfloat best = (vfloat)(NOTHING);
    for (int i = lane; i < hypotheses.count; i += GROUP * LANES) {
      vfloat q = VLOAD(scores + at + i);
      if (!begins) {
        const vfloat one = max(VLOAD(before + i - 1), VLOAD(before + i + 1)) - one_step;
        const vfloat two = max(VLOAD(before + i - 2), VLOAD(before + i + 2)) - two_steps;
        const vfloat from =
            max(max(VLOAD(before + i), (vfloat)(best_before - price)), max(one, two));
        q += from - best_before;
      }
#if LANES > 1
      if (i + LANES > hypotheses.count)
        q = VSELECT((vfloat)(NOTHING), q, i + VLANES < hypotheses.count);
#endif
      VSTORE(q, now + i);
      best = max(best, q);
      if (keep) {
        __global float* out = aggregated + at + i;
        VSTORE(add ? VLOAD(out) + q : q, out);
      }
    }
    MEET;
    best_before = largest_of_group(largest_lane(best), shared);
    __local float* swapped = before;
    before = now;
    now = swapped;
    begins = 0;
  }
}
