// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Propagation (section 4.4): an accepted estimate is written into every other view that sees its
// point in a similar colour. Where estimates meet the nearer one stays, then the more confident one.
// A view that is finished takes in only what is more confident than a bar, which is set by what it
// had before the first estimate of this reference view arrived: every arrival is judged alone, so
// the result does not depend on the order or the partition of a reference view's estimates.
//   active     [active_count] places in the band of the views that keep estimates; -1: not there
//   disparity  [v][pitch]; NaN: not accepted
//   confidence [v][pitch]; radiance [v][pitch][3]
//   bars       [v - begin][active view][width]; 0: not set, below 0: nothing was there
//   estimates  [v - begin][active view][width] packed: ordered(hypothesis) << 32 | bits of
//              confidence; 0: none
// The first `finished` active views have bars: set_bars, then propagation; clear_bars when all rows
// of the reference view are through.
// ATOMIC 1: one work-item per (pixel, row). ATOMIC 0, for devices without 64-bit atomics: one per
// active view, whose estimates nobody else writes.

#ifndef ATOMIC
#define ATOMIC 0
#endif
#if ATOMIC
#pragma OPENCL EXTENSION cl_khr_int64_extended_atomics : enable
#endif

// Where a ray arrives in a view.
typedef struct {
  int x, y;
  float h;
} Arrival;

static inline int arrive(const BandParams p, __global const float* rays, int view, int u, int v,
                         float h, int reached_begin, int reached_end, Arrival* at) {
  float x = u, y = v;
  at->h = h;
  if (!locate(rays, view, u, v, h, &x, &y, &at->h)) return 0;
  if (!(x > -0.5f && x < p.width - 0.5f && y > -0.5f && y < p.height - 0.5f)) return 0;
  at->x = min((int)floor(x + 0.5f), p.width - 1);
  at->y = min((int)floor(y + 0.5f), p.height - 1);
  return at->y >= reached_begin && at->y < reached_end;
}

static inline size_t state_index(const Arrival at, int begin, int active_count, int target,
                                 int width) {
  return ((size_t)(at.y - begin) * active_count + target) * width + at.x;
}

static inline void propagate_pixel(__global const float* band, const BandParams p,
                                   const StripParams strip, __global const float* rays, int view,
                                   int target, int active_count, int u, int v, float h,
                                   float confidence, __global const float* radiance,
                                   float tolerance, int reached_begin, int reached_end, int begin,
                                   int finished,
                                   __global const float* bars, volatile __global ulong* estimates) {
  Arrival arrival;
  if (!arrive(p, rays, view, u, v, h, reached_begin, reached_end, &arrival)) return;
  if (view != strip.ref) {
    __global const float* there = band_row(band, p, view, arrival.y) + arrival.x;
    float d2 = 0.0f;
    for (int c = 0; c < 3; ++c) {
      const float d = there[c * p.stride] - radiance[c];
      d2 += d * d;
    }
    if (!(d2 < tolerance * tolerance)) return;
  }
  const size_t at = state_index(arrival, begin, active_count, target, p.width);
  if (target < finished && !(confidence > bars[at])) return;
  const ulong packed = packed_estimate(arrival.h, confidence);
#if ATOMIC
  atom_max(estimates + at, packed);
#else
  estimates[at] = max(estimates[at], packed);
#endif
}

// What an arrival must exceed in confidence.
static inline float bar_of(ulong own, float finished_lead) {
  return own == 0 ? -1.0f : max(finished_lead * as_float((uint)own), FLT_MIN);
}

// Sets a bar that is not set. All that arrive here write the same.
static inline void set_bar(volatile __global float* bar, float value) {
#if ATOMIC
  atomic_cmpxchg((volatile __global int*)bar, 0, as_int(value));
#else
  if (*bar == 0.0f) *bar = value;
#endif
}

static inline void clear_bar(volatile __global float* bar) {
#if ATOMIC
  atomic_xchg(bar, 0.0f);
#else
  *bar = 0.0f;
#endif
}

// Work-items of all three kernels.
#if ATOMIC
#define FOR_EACH_ARRIVAL(targets)                                    \
  const int u = get_global_id(0), row = get_global_id(1);            \
  if (u >= p.width) return;                                          \
  if (isnan(disparity[view_index(strip, row, u)])) return;            \
  for (int target = 0; target < (targets); ++target)
#else
#define FOR_EACH_ARRIVAL(targets)                                    \
  const int target = get_global_id(0);                               \
  if (target >= (targets)) return;                                   \
  for (int row = 0; row < strip.row_end - strip.row_begin; ++row)    \
    for (int u = 0; u < p.width; ++u)                                \
      if (!isnan(disparity[view_index(strip, row, u)]))
#endif

__kernel void set_bars(const BandParams p, const StripParams strip, __global const float* rays,
                       __global const int* active, const int active_count,
                       __global const float* disparity, const int reached_begin, const int reached_end, const int begin,
                       const int finished, const float finished_lead,
                       __global const ulong* estimates, __global float* bars) {
  FOR_EACH_ARRIVAL(finished) {
    Arrival arrival;
    if (active[target] < 0 || !arrive(p, rays, active[target], u, strip.row_begin + row,
                                      disparity[view_index(strip, row, u)], reached_begin, reached_end,
                                      &arrival))
      continue;
    const size_t at = state_index(arrival, begin, active_count, target, p.width);
    set_bar(bars + at, bar_of(estimates[at], finished_lead));
  }
}

__kernel void propagation(__global const float* band, const BandParams p, const StripParams strip,
                          __global const float* rays, __global const int* active,
                          const int active_count, __global const float* disparity,
                          __global const float* confidence, __global const float* radiance,
                          const float tolerance, const int reached_begin, const int reached_end, const int begin,
                          const int finished, __global const float* bars,
                          __global ulong* estimates) {
  FOR_EACH_ARRIVAL(active_count) {
    const size_t pixel = view_index(strip, row, u);
    if (active[target] >= 0)
      propagate_pixel(band, p, strip, rays, active[target], target, active_count, u,
                      strip.row_begin + row, disparity[pixel], confidence[pixel],
                      radiance + 3 * pixel, tolerance, reached_begin, reached_end, begin, finished, bars,
                      estimates);
  }
}

__kernel void clear_bars(const BandParams p, const StripParams strip, __global const float* rays,
                         __global const int* active, const int active_count,
                         __global const float* disparity, const int reached_begin,
                         const int reached_end, const int begin, const int finished, __global float* bars) {
  FOR_EACH_ARRIVAL(finished) {
    Arrival arrival;
    if (active[target] >= 0 &&
        arrive(p, rays, active[target], u, strip.row_begin + row,
               disparity[view_index(strip, row, u)], reached_begin, reached_end, &arrival))
      clear_bar(bars + state_index(arrival, begin, active_count, target, p.width));
  }
}
