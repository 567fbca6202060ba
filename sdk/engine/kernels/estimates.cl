// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Estimates from winners, and those of all active views of a level:
//   estimates  [v - begin][stored view][width] packed, see propagation.cl
// Maps are of the whole view, strips of the given rows alone.
// One work-item per (pixel, row) unless stated.

static inline size_t active_index(const StripParams strip, int v, int begin, int active,
                                  int active_count, int u) {
  return ((size_t)(v - begin) * active_count + active) * strip.width + u;
}

static inline float hypothesis_of(ulong estimate) {
  if (estimate == 0) return NAN;
  const uint key = (uint)(estimate >> 32);
  return as_float(key & 0x80000000u ? key & 0x7fffffffu : ~key);
}

static inline float confidence_of(ulong estimate) { return as_float((uint)estimate); }

__kernel void unpack_estimates(const StripParams strip, __global const ulong* estimates,
                               const int begin, const int active, const int active_count,
                               __global float* disparity, __global float* confidence) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const ulong estimate = estimates[active_index(strip, v, begin, active, active_count, u)];
  disparity[view_index(strip, row, u)] = hypothesis_of(estimate);
  confidence[view_index(strip, row, u)] = confidence_of(estimate);
}

// Fills a pixel between the nearest estimates of its row, else of its column, when no more than
// `crack` pixels lie between them and they differ by no more than `apart`.
__kernel void close_cracks(const StripParams strip, const int height, const int crack,
                           const float apart, __global const float* disparity,
                           __global const float* confidence, __global float* closed,
                           __global float* closed_confidence, __global ulong* estimates,
                           const int begin, const int active, const int active_count) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  float h = disparity[pixel], c = confidence[pixel];
  for (int along = 0; along < 2 && isnan(h); ++along) {
    const int place = along ? v : u, length = along ? height : strip.width;
    const long step = along ? strip.pitch : 1;
    int before = 1, after = 1;
    while (before <= crack && place - before >= 0 && isnan(disparity[(long)pixel - before * step]))
      ++before;
    while (after <= crack && place + after < length && isnan(disparity[(long)pixel + after * step]))
      ++after;
    const int holes = before + after - 1;
    if (holes > crack || place - before < 0 || place + after >= length) continue;
    const size_t first = (long)pixel - before * step, last = (long)pixel + after * step;
    const float low = disparity[first], high = disparity[last];
    if (!(fabs(high - low) <= apart)) continue;
    h = low + quotient((high - low) * (float)before, (float)(holes + 1));
    c = fmin(confidence[first], confidence[last]);
    estimates[active_index(strip, v, begin, active, active_count, u)] = packed_estimate(h, c);
  }
  closed[pixel] = h;
  closed_confidence[pixel] = c;
}

// Winners of a strip into the maps. min_relief: below 0, there is no `best`.
__kernel void take_winners(const StripParams strip, const HypothesisReals hypotheses,
                           const int is_last_level, const float min_relief, const int has_edges,
                           __global const uchar* todo, __global const ushort2* bounds,
                           __global const float* winners, __global const float* contrast,
                           __global const float* best, __global const float* edges,
                           __global float* disparity, __global float* confidence) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u), at = map_index(strip, row, u);
  if (!todo[pixel]) return;
  float h = winners[at], c = contrast[at];
  // All hypotheses score alike: no information.
  if (min_relief >= 0.0f && !(c > min_relief * best[at])) c = 0.0f;
  // Too few views saw it under any hypothesis: on the last level the farther bound has to do.
  if (isnan(h) && is_last_level) h = hypothesis_value(hypotheses, bounds[pixel].x);
  disparity[pixel] = h;
  confidence[pixel] = has_edges ? c * edges[at] : c;
}

// Beside a silhouette half of the views see the nearer surface, and its score wins there too: where
// the best half of the views likes something farther better, that is the answer.
__kernel void step_back(const StripParams strip, const float farther, const float lead,
                        __global const float* winners, __global const float* contrast,
                        __global const float* best, __global const float* own,
                        __global float* disparity, __global float* confidence) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u), at = map_index(strip, row, u);
  // NaN where there is nothing to do: no comparison holds.
  if (!(winners[at] < disparity[pixel] - farther)) return;
  if (!(best[at] >= own[at] + lead)) return;
  disparity[pixel] = winners[at];
  confidence[pixel] = contrast[at];
}

__kernel void accept(const StripParams strip, const float threshold, __global const uchar* todo,
                     __global const float* confidence, __global float* estimates) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  if (!todo[pixel] || !(confidence[pixel] > threshold)) estimates[pixel] = NAN;
}

// Estimates of every row. One work-item per row.
__kernel void count_estimates(const StripParams strip, __global const float* disparity,
                              __global int* counts) {
  const int row = get_global_id(0);
  if (row >= strip.row_end - strip.row_begin) return;
  int count = 0;
  for (int u = 0; u < strip.width; ++u) count += !isnan(disparity[view_index(strip, row, u)]);
  counts[row] = count;
}

// Sums of all counts before each, and at the end of all. One work-item.
__kernel void sum_counts(const int size, __global int* counts) {
  int sum = 0;
  for (int i = 0; i < size; ++i) {
    const int count = counts[i];
    counts[i] = sum;
    sum += count;
  }
  counts[size] = sum;
}

// Mirrors RayTuple.
typedef struct {
  float hypothesis, confidence, r, g, b;
  int view, u, v, level;
} Tuple;

// places: from sum_counts. One work-item per row.
__kernel void compact_tuples(const StripParams strip, const int view, const int level,
                             __global const float* disparity, __global const float* confidence,
                             __global const float* radiance, __global const int* places,
                             __global Tuple* tuples) {
  const int row = get_global_id(0), v = strip.row_begin + row;
  if (row >= strip.row_end - strip.row_begin) return;
  __global Tuple* out = tuples + places[row];
  for (int u = 0; u < strip.width; ++u) {
    const size_t pixel = view_index(strip, row, u);
    const float h = disparity[pixel];
    if (isnan(h)) continue;
    out->hypothesis = h;
    out->confidence = confidence[pixel];
    out->r = radiance[3 * pixel];
    out->g = radiance[3 * pixel + 1];
    out->b = radiance[3 * pixel + 2];
    out->view = view;
    out->u = u;
    out->v = v;
    out->level = level;
    ++out;
  }
}

// Depth bounds of one level down (section 4.5), one work-item per coarse row. strip: of the coarse
// level.
//   estimates, search  of the fine level; search [v - search_begin][stored view][fine width][4], with
//                      has_search 1
//   scratch            [coarse row][fine width][2]
//   coarse             [v - coarse_begin][stored view][width][4]: low, high, known low, known high
typedef struct {
  float low, high;  // NaN: nothing is known
} Interval;

static inline Interval joined(Interval a, Interval b) {
  if (isnan(b.low)) return a;
  if (isnan(a.low)) return b;
  const Interval both = {fmin(a.low, b.low), fmax(a.high, b.high)};
  return both;
}

static inline Interval known_at(__global const ulong* estimates, size_t at,
                                __global const float* search, int has_search, size_t finer_at) {
  Interval known = {NAN, NAN};
  if (estimates[at] != 0) known.low = known.high = hypothesis_of(estimates[at]);
  if (has_search) {
    const Interval finer = {search[4 * finer_at + 2], search[4 * finer_at + 3]};
    known = joined(known, finer);
  }
  return known;
}

__kernel void coarsen_bounds(const StripParams strip, const float range_min, const float range_max,
                             const int fine_width, const int fine_height,
                             __global const ulong* estimates, const int begin, const int active,
                             const int active_count, const int has_search,
                             __global const float* search, const int search_begin,
                             const int search_at, const int search_views,
                             __global Interval* scratch, __global float* coarse,
                             const int coarse_begin, const int coarse_at,
                             const int coarse_views) {
  const int row = get_global_id(0), v = strip.row_begin + row;
  if (row >= strip.row_end - strip.row_begin) return;
  __global float* out =
      coarse + 4 * (((size_t)(v - coarse_begin) * coarse_views + coarse_at) * strip.width);
  for (int i = 0; i < 4 * strip.width; ++i) out[i] = NAN;
  __global Interval* from_left = scratch + (size_t)row * fine_width;
  for (int y = 2 * v; y < min(2 * v + 2, fine_height); ++y) {
    const size_t line = ((size_t)(y - begin) * active_count + active) * fine_width;
    const size_t finer = ((size_t)(y - search_begin) * search_views + search_at) * fine_width;
    Interval nearest = {NAN, NAN};
    for (int u = 0; u < fine_width; ++u) {
      from_left[u] = nearest;
      const Interval known = known_at(estimates, line + u, search, has_search, finer + u);
      if (!isnan(known.low)) nearest = known;
    }
    nearest.low = nearest.high = NAN;
    for (int u = fine_width - 1; u >= 0; --u) {
      __global float* here = out + 4 * (u / 2);
      const Interval known = known_at(estimates, line + u, search, has_search, finer + u);
      const Interval known_here = {here[2], here[3]};
      const Interval all_known = joined(known_here, known);
      here[2] = all_known.low;
      here[3] = all_known.high;
      const int has_estimate =
          estimates[line + u] != 0 || (has_search && isnan(search[4 * (finer + u)]));
      if (!has_estimate) {
        Interval bounds = {range_min, range_max};
        if (!isnan(from_left[u].low) && !isnan(nearest.low))
          bounds = joined(joined(from_left[u], nearest), known);
        const Interval before = {here[0], here[1]};
        bounds = joined(bounds, before);
        here[0] = bounds.low;
        here[1] = bounds.high;
      }
      if (!isnan(known.low)) nearest = known;
    }
  }
}

// Maps of a level: its own estimates, else those of the coarser level's maps (has_coarse 1), where the
// view shows something (has_shown 1: [v - shown_begin][stored view][shown_width], of level 0 alone).
__kernel void fill_view(const StripParams strip, const int level, const int active,
                        const int active_count, __global const ulong* estimates, const int begin,
                        const int has_coarse, const int coarse_pitch,
                        __global const float* coarse_disparity,
                        __global const float* coarse_confidence,
                        __global const char* coarse_level, const int has_shown,
                        __global const uchar* shown, const int shown_begin, const int shown_width,
                        const int shown_views, const int shown_at, __global float* disparity,
                        __global float* confidence, __global char* decided) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  const size_t above = (size_t)(v / 2) * coarse_pitch + GIGARAY_PAD + u / 2;
  const ulong estimate = estimates[active_index(strip, v, begin, active, active_count, u)];
  disparity[pixel] = confidence[pixel] = as_float(0x7fc00000);  // the NaN of the host, to the bit
  decided[pixel] = -1;
  if (has_shown &&
      !shown[((size_t)(v - shown_begin) * shown_views + shown_at) * shown_width + u])
    return;
  if (estimate != 0) {
    disparity[pixel] = hypothesis_of(estimate);
    confidence[pixel] = confidence_of(estimate);
    decided[pixel] = level;
  } else if (has_coarse) {
    disparity[pixel] = coarse_disparity[above];
    confidence[pixel] = coarse_confidence[above];
    decided[pixel] = coarse_level[above];
  }
}
