// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What is to do in the reference view. Masks are bytes; maps of the whole view unless they are called
// strips, of which row 0 is row `begin` of the view.
// One work-item per (pixel, row), but for the counts.

static inline size_t at_row(const StripParams strip, int v, int begin, int u) {
  return (size_t)(v - begin) * strip.pitch + GIGARAY_PAD + u;
}

// 1 where the edge confidence, a strip of these rows, is above the threshold.
__kernel void edge_mask(const StripParams strip, __global const float* confidence,
                        const float threshold, __global uchar* mask) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  mask[map_index(strip, row, u)] = confidence[map_index(strip, row, u)] > threshold;
}

// Least (MOST 0) or greatest of a pixel and its four neighbours. Both maps may be strips.
static inline void over_cross(const StripParams strip, int height, __global const uchar* in,
                              int in_begin, __global uchar* out, int out_begin, int most) {
  const int u = get_global_id(0), v = strip.row_begin + get_global_id(1);
  if (u >= strip.width) return;
  const uchar here = in[at_row(strip, v, in_begin, u)];
  const uchar above = in[at_row(strip, max(v - 1, 0), in_begin, u)];
  const uchar below = in[at_row(strip, min(v + 1, height - 1), in_begin, u)];
  const uchar left = in[at_row(strip, v, in_begin, max(u - 1, 0))];
  const uchar right = in[at_row(strip, v, in_begin, min(u + 1, strip.width - 1))];
  out[at_row(strip, v, out_begin, u)] =
      most ? max(max(max(above, below), max(left, right)), here)
           : min(min(min(above, below), min(left, right)), here);
}

__kernel void erode(const StripParams strip, const int height, __global const uchar* in,
                    const int in_begin, __global uchar* out, const int out_begin) {
  over_cross(strip, height, in, in_begin, out, out_begin, 0);
}

__kernel void dilate(const StripParams strip, const int height, __global const uchar* in,
                     const int in_begin, __global uchar* out, const int out_begin) {
  over_cross(strip, height, in, in_begin, out, out_begin, 1);
}

// A strip of a mask into the rows of a view: [v - to_begin][stored view][width].
__kernel void put_mask(const StripParams strip, __global const uchar* mask, const int mask_begin,
                       __global uchar* to, const int to_begin, const int at,
                       const int stored_views) {
  const int u = get_global_id(0), v = strip.row_begin + get_global_id(1);
  if (u >= strip.width) return;
  to[((size_t)(v - to_begin) * stored_views + at) * strip.width + u] =
      mask[at_row(strip, v, mask_begin, u)];
}

// Pixels that have no estimate and want one.
//   mask    [v - mask_begin][stored view][width]; 0: not worth trying
//   shown   [(v << shift) - shown_begin][stored view][shown_width]; 0: shows nothing of the scene
//   search  [v - search_begin][stored view][width][4]: bounds from finer levels; NaN: all finer pixels
//           have an estimate
// *_at: which of the stored views it is. has_*: 0, there is none and all pixels are alike.
__kernel void select_todo(const StripParams strip, const HypothesisReals hypotheses,
                          __global const float* disparity, const int has_mask,
                          __global const uchar* mask, const int mask_begin, const int mask_at,
                          const int mask_views, const int has_shown,
                          __global const uchar* shown, const int shown_begin,
                          const int shown_width, const int shown_shift, const int shown_views,
                          const int shown_at, const int has_search, __global const float* search,
                          const int search_begin, const int search_at,
                          const int search_views, __global uchar* todo,
                          __global ushort2* bounds) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  todo[pixel] = 0;
  bounds[pixel] = (ushort2)(0, 0);
  if (!isnan(disparity[pixel])) return;
  if (has_mask && !mask[((size_t)(v - mask_begin) * mask_views + mask_at) * strip.width + u])
    return;
  if (has_shown) {
    const size_t line = (size_t)((v << shown_shift) - shown_begin) * shown_views + shown_at;
    if (!shown[line * shown_width + ((size_t)u << shown_shift)]) return;
  }
  ushort2 wanted = (ushort2)(0, hypotheses.count - 1);
  if (has_search) {
    __global const float* known =
        search + 4 * (((size_t)(v - search_begin) * search_views + search_at) * strip.width + u);
    if (isnan(known[0])) return;
    wanted = hypotheses_between(hypotheses, known[0], known[1], 1);
  }
  todo[pixel] = 1;
  bounds[pixel] = wanted;
}

#define THIN 3             // px: half of what counts as thin
#define AROUND (2 * THIN)  // px
#define HOLE_MARGIN 8      // hypotheses

__kernel void bound_thin_holes(const StripParams strip, const HypothesisReals hypotheses,
                               const int height, __global const uchar* todo,
                               __global const uchar* wide, __global const float* estimates,
                               __global ushort2* bounds) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  if (!todo[pixel] || wide[pixel]) return;
  float low = INFINITY, high = -INFINITY;
  for (int y = max(v - AROUND, 0); y <= min(v + AROUND, height - 1); ++y)
    for (int x = max(u - AROUND, 0); x <= min(u + AROUND, strip.width - 1); ++x) {
      const float h = estimates[at_row(strip, y, 0, x)];
      if (isnan(h)) continue;
      low = min(low, h);
      high = max(high, h);
    }
  if (low <= high) bounds[pixel] = hypotheses_between(hypotheses, low, high, HOLE_MARGIN);
}

// All pixels within `radius` along u of one to do, with the union of their bounds; then along v of the
// answer.
static inline void join_bounds(uchar* todo, ushort2* bounds, uchar other_todo, ushort2 other) {
  if (!other_todo) return;
  *bounds = *todo ? (ushort2)(min((*bounds).x, other.x), max((*bounds).y, other.y)) : other;
  *todo = 1;
}

__kernel void grow_along_u(const StripParams strip, const int radius, __global const uchar* todo,
                           __global const ushort2* bounds, __global uchar* grown,
                           __global ushort2* grown_bounds) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  uchar any = 0;
  ushort2 joined = (ushort2)(0, 0);
  for (int x = max(u - radius, 0); x <= min(u + radius, strip.width - 1); ++x)
    join_bounds(&any, &joined, todo[view_index(strip, row, x)], bounds[view_index(strip, row, x)]);
  grown[view_index(strip, row, u)] = any;
  grown_bounds[view_index(strip, row, u)] = joined;
}

__kernel void grow_along_v(const StripParams strip, const int radius, const int height,
                           __global const uchar* todo, __global const ushort2* bounds,
                           __global uchar* grown, __global ushort2* grown_bounds) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  uchar any = 0;
  ushort2 joined = (ushort2)(0, 0);
  for (int y = max(v - radius, 0); y <= min(v + radius, height - 1); ++y)
    join_bounds(&any, &joined, todo[at_row(strip, y, 0, u)], bounds[at_row(strip, y, 0, u)]);
  grown[view_index(strip, row, u)] = any;
  grown_bounds[view_index(strip, row, u)] = joined;
}

// 1 at pixels whose right or lower neighbour differs by more than `jump`.
__kernel void find_jumps(const StripParams strip, const int height, __global const float* map,
                         const float jump, __global uchar* jumps) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const float here = map[view_index(strip, row, u)];
  jumps[view_index(strip, row, u)] =
      (u + 1 < strip.width && fabs(here - map[view_index(strip, row, u + 1)]) > jump) ||
      (v + 1 < height && fabs(here - map[at_row(strip, v + 1, 0, u)]) > jump);
}

// Pixels to do with a jump within `reach` in both directions: first along u, then along v.
__kernel void jumps_along_u(const StripParams strip, const int reach, __global const uchar* jumps,
                            __global uchar* near) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  uchar any = 0;
  for (int x = max(u - reach, 0); x <= min(u + reach, strip.width - 1); ++x)
    any |= jumps[view_index(strip, row, x)];
  near[view_index(strip, row, u)] = any;
}

__kernel void beside_jumps(const StripParams strip, const int height, const int reach,
                           __global const uchar* near, __global const uchar* todo,
                           __global uchar* beside) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  uchar any = 0;
  for (int y = max(v - reach, 0); y <= min(v + reach, height - 1); ++y)
    any |= near[at_row(strip, y, 0, u)];
  beside[view_index(strip, row, u)] = any && todo[view_index(strip, row, u)];
}

// Pixels of every row that are set. One work-item per row.
__kernel void count_rows(const StripParams strip, __global const uchar* mask, __global int* counts) {
  const int row = get_global_id(0);
  if (row >= strip.row_end - strip.row_begin) return;
  int count = 0;
  for (int u = 0; u < strip.width; ++u) count += mask[view_index(strip, row, u)] != 0;
  counts[row] = count;
}

// Pixels of blocks of `lanes` that are less than half full stand alone, see density_score.cl: they are
// left out of `together` and counted row by row. One work-item per row, here and below.
static inline int stand_alone(const StripParams strip, __global const uchar* todo, int row, int u,
                              int lanes) {
  int count = 0;
  for (int x = u; x < min(u + lanes, strip.width); ++x)
    count += todo[view_index(strip, row, x)] != 0;
  return 2 * count < lanes ? count : 0;
}

__kernel void find_lonely(const StripParams strip, const int lanes, __global const uchar* todo,
                          __global uchar* together, __global int* counts) {
  const int row = get_global_id(0);
  if (row >= strip.row_end - strip.row_begin) return;
  counts[row] = 0;
  for (int u = 0; u < strip.width; u += lanes) {
    const int alone = stand_alone(strip, todo, row, u, lanes);
    for (int x = u; x < min(u + lanes, strip.width); ++x)
      together[view_index(strip, row, x)] = alone ? 0 : todo[view_index(strip, row, x)];
    counts[row] += alone;
  }
}

// packed: [pixel][2] row of the strip, column. places: of the rows, from sum_counts.
__kernel void pack_lonely(const StripParams strip, const int lanes, __global const uchar* todo,
                          __global const int* places, __global int* packed) {
  const int row = get_global_id(0);
  if (row >= strip.row_end - strip.row_begin) return;
  int place = places[row];
  for (int u = 0; u < strip.width; u += lanes) {
    if (!stand_alone(strip, todo, row, u, lanes)) continue;
    for (int x = u; x < min(u + lanes, strip.width); ++x) {
      if (!todo[view_index(strip, row, x)]) continue;
      packed[2 * place] = row;
      packed[2 * place + 1] = x;
      ++place;
    }
  }
}
