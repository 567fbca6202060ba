// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The winner (eq. 6) and how far it stands out (eq. 7, the mean over the tested hypotheses).
//   scores     [row][hypothesis][pitch]; negative: not tested
//   todo, bounds as for density_score
//   disparity  [row][pitch], level-0 px per view step (or inverse depth); NaN: no estimate
//   contrast   [row][pitch], best score minus mean score
// One work-item per (block of LANES pixels, row). Of equal scores the smallest hypothesis wins.

#ifndef REFINE
#define REFINE 0  // 1: vertex of the parabola through the winner and its neighbours
#endif

__kernel void winner(const StripParams strip, const HypothesisParams hypotheses,
                     __global const uchar* todo, __global const ushort2* bounds,
                     __global const float* scores, __global float* disparity,
                     __global float* contrast) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  int any_first = hypotheses.count, any_last = -1;
  vint first = (vint)(1), last = (vint)(0);
  for (int lane = 0; lane < LANES; ++lane) {
    const size_t i = map_index(strip, row, u + lane);
    if (todo[i]) {
      ((int*)&first)[lane] = bounds[i].x;
      ((int*)&last)[lane] = bounds[i].y;
      any_first = min(any_first, (int)bounds[i].x);
      any_last = max(any_last, (int)bounds[i].y);
    }
  }
  __global float* out = disparity + map_index(strip, row, u);
  if (any_last < 0) {
    VSTORE((vfloat)(NAN), out);
    VSTORE((vfloat)(0.0f), contrast + map_index(strip, row, u));
    return;
  }

  __global const float* column = scores + score_index(strip, hypotheses.count, row, 0, u);
  vfloat best = (vfloat)(-1.0f), sum = (vfloat)(0.0f), tested = (vfloat)(0.0f);
  vint best_index = (vint)(-1);
  for (int i = any_first; i <= any_last; ++i) {
    const vfloat s = VLOAD(column + (size_t)i * strip.pitch);
    const vint valid = i >= first && i <= last && s >= 0.0f;
    sum += VSELECT((vfloat)(0.0f), s, valid);
    tested += VSELECT((vfloat)(0.0f), (vfloat)(1.0f), valid);
    const vint better = valid && s > best;
    best = VSELECT(best, s, better);
    best_index = VSELECT(best_index, (vint)(i), better);
  }
  VSTORE(VSELECT((vfloat)(0.0f), best - sum / fmax(tested, 1.0f), best_index >= 0),
         contrast + map_index(strip, row, u));

  for (int lane = 0; lane < LANES; ++lane) {
    const int i = ((const int*)&best_index)[lane];
    float h = NAN;
    if (i >= 0) {
      h = hypotheses.min + i * hypotheses.step;
#if REFINE
      if (i > ((const int*)&first)[lane] && i < ((const int*)&last)[lane]) {
        __global const float* s = column + (size_t)i * strip.pitch + lane;
        const float before = s[-strip.pitch], peak = s[0], after = s[strip.pitch];
        const float curve = before - 2.0f * peak + after;
        if (before >= 0.0f && after >= 0.0f && curve < 0.0f)
          h += hypotheses.step * clamp(0.5f * (before - after) / curve, -0.5f, 0.5f);
      }
#endif
    }
    out[lane] = h;
  }
}
