// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The winner (eq. 6) and how far it stands out (eq. 7, the mean over the tested hypotheses).
//   chosen_by  [row - scores_begin][u][hypothesis]: their largest decides, then the largest of `scores`
//              no farther than `search` hypotheses from it; the same volume as `scores` unless there was
//              a scan-line step
//   scores     [row - scores_begin][u][hypothesis]; negative: not tested
//   todo, bounds as for density_score
//   disparity  [row][pitch], level-0 px per view step (or inverse depth); NaN: no estimate
//   contrast   [row][pitch], best score minus mean score
// One work-item per pixel; lanes are hypotheses. Of equal scores the smallest hypothesis wins.

//   peak_share, peak_width, widest_peak  see WinnerOptions; with PEAK 1

#ifndef PEAK
#define PEAK 0  // 1: contrast counts less where the peak is wide
#endif
#ifndef REFINE
#define REFINE 0  // 1: vertex of the parabola through the winner and its neighbours
#endif

__kernel void winner(const StripParams strip, const HypothesisParams hypotheses,
                     __global const uchar* todo, __global const ushort2* bounds,
                     __global const float* chosen_by, __global const float* scores,
                     const int scores_begin, const int search, const float peak_share,
                     const int peak_width, const int widest_peak, __global float* disparity,
                     __global float* contrast) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  const size_t pixel = map_index(strip, row, u), in_view = view_index(strip, row, u);
  disparity[pixel] = NAN;
  contrast[pixel] = 0.0f;
  if (!todo[in_view]) return;
  const int first = bounds[in_view].x, last = bounds[in_view].y;
  const size_t at = score_index(strip, hypotheses, strip.row_begin + row - scores_begin, u);
  __global const float* choice = chosen_by + at;
  __global const float* score = scores + at;

  vfloat best = (vfloat)(-INFINITY), sum = (vfloat)(0.0f), tested = (vfloat)(0.0f);
  vint best_index = (vint)(INT_MAX);
  for (int i = lanes_floor(first); i <= last; i += LANES) {
    const vint index = i + VLANES;
    const vfloat s = VLOAD(score + i), c = VLOAD(choice + i);
    const vint valid = VTRUE(index >= first && index <= last && s >= 0.0f);
    sum += VSELECT((vfloat)(0.0f), s, valid);
    tested += VSELECT((vfloat)(0.0f), (vfloat)(1.0f), valid);
    const vint better = VTRUE(valid && c > best);
    best = VSELECT(best, c, better);
    best_index = VSELECT(best_index, index, better);
  }
  float lane_best[LANES];
  int lane_index[LANES];
  VSTORE(best, lane_best);
#if LANES == 1
  lane_index[0] = best_index;
#else
  CONCAT(vstore, LANES)(best_index, 0, lane_index);
#endif
  int winner = lane_index[0];
  float most = lane_best[0];
  for (int lane = 1; lane < LANES; ++lane)
    if (lane_best[lane] > most || (lane_best[lane] == most && lane_index[lane] < winner)) {
      most = lane_best[lane];
      winner = lane_index[lane];
    }
  if (winner == INT_MAX) return;

  const int chosen = winner;
  for (int i = max(chosen - search, first); i <= min(chosen + search, last); ++i)
    if (score[i] > score[winner]) winner = i;
  const float lead = score[winner] - sum_of_lanes(sum) / sum_of_lanes(tested);
  contrast[pixel] = lead;
#if PEAK
  const float bar = score[winner] - peak_share * lead;
  vfloat wide = (vfloat)(0.0f);
  for (int i = lanes_floor(first); i <= last; i += LANES) {
    const vint index = i + VLANES;
    const vint counts = VTRUE(index >= first && index <= last && VLOAD(score + i) >= bar);
    wide += VSELECT((vfloat)(0.0f), (vfloat)(1.0f), counts);
  }
  const float width = sum_of_lanes(wide);
  contrast[pixel] = width > (float)widest_peak ? 0.0f : lead * min((float)peak_width / width, 1.0f);
#endif
  float h = hypotheses.min + winner * hypotheses.step;
#if REFINE
  if (winner > first && winner < last) {
    const float before = score[winner - 1], peak = score[winner], after = score[winner + 1];
    const float curve = before - 2.0f * peak + after;
    if (before >= 0.0f && after >= 0.0f && curve < 0.0f)
      h += hypotheses.step * clamp(0.5f * (before - after) / curve, -0.5f, 0.5f);
  }
#endif
  disparity[pixel] = h;
}

// The score of the hypothesis next to an estimate.
//   disparity  [v - disparity_begin][pitch], NaN: no estimate
//   out        [row][pitch], NaN where there is no estimate or nothing to do
// One work-item per pixel.
__kernel void score_of_estimate(const StripParams strip, const HypothesisParams hypotheses,
                                __global const uchar* todo, __global const float* scores,
                                const int scores_begin, __global const float* disparity,
                                const int disparity_begin, __global float* out) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  const size_t pixel = map_index(strip, row, u);
  out[pixel] = NAN;
  const float h = disparity[map_index(strip, strip.row_begin + row - disparity_begin, u)];
  if (!todo[view_index(strip, row, u)] || isnan(h)) return;
  const int i = clamp((int)rint((h - hypotheses.min) / hypotheses.step), 0,
                      hypotheses.count - 1);
  out[pixel] =
      scores[score_index(strip, hypotheses, strip.row_begin + row - scores_begin, u) + i];
}
