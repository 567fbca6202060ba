// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Robust score: kernels around the reference pixel's own values, a triangle with a tail (TAIL_SHARE) of
// colour and a triangle of the gradient,
//   K = (1 - share) Kc + share Kg min(1, 4 Kc),
// averaged over the other views: the reference agrees with itself under any hypothesis. The gate keeps an occluder of another colour from scoring by its gradient.
//   band    [slot][view][5][stride]: RGB, gx, gy
//   members [view] bit 0: the view counts; HALF_PLANES 1: bit i: it lies in half-plane i of the camera
//           positions (view_sets.h)
//   own     the reference view: view own_view of a band with parameters own_p
//   unseen  what a view is taken to say that is missing to floor_views
//   colour_slack, gradient_slack  with SLACK 1: the bandwidths grow by so many times the length of the
//           reference pixel's gradient
//   others as for density_score
// HALF_PLANES 1: the largest of the averages over the 8 half-planes; a point beside a silhouette is
// hidden from one side only.
// One work-item per (block of UNITS * LANES pixels, row): where a view sees it is found once for the
// block, and what is interpolated between rows serves the next unit too. HYPOTHESES neighbouring ones
// take turns at a view, whose rows stay in the nearest cache meanwhile. SHIFT_ALIKE 0: samples come
// from taps, one hypothesis after the other, and gradients are turned into the axes of the reference
// view.

#ifndef UNITS
#define UNITS 1  // vectors of LANES pixels per work-item
#endif
#ifndef HYPOTHESES
#define HYPOTHESES 1  // their sums are in private memory, 2 UNITS vectors each
#endif
#ifndef MASKED
#define MASKED 0  // 1: some pixels of the band are masked, samples of them count for nothing
#endif
#ifndef HALF_PLANES
#define HALF_PLANES 0
#endif
#ifndef SLACK
#define SLACK 0
#endif
#if HALF_PLANES
#define PARTS 8
#else
#define PARTS 1
#endif
// Hypotheses that take turns: no more memory for the sums of half-planes than for others.
#define TILE ((HYPOTHESES + PARTS - 1) / PARTS)
// Indices of arrays that may have one element: then it can be in registers.
#if UNITS == 1
#define UNIT(j) 0
#else
#define UNIT(j) (j)
#endif
#if TILE == 1
#define TURN(i) 0
#else
#define TURN(i) (i)
#endif

// distance: in bandwidths.
static inline vfloat tailed_kernel(vfloat distance) {
  return (1.0f - TAIL_SHARE) * max(1.0f - distance, (vfloat)(0.0f)) +
         TAIL_SHARE * max(1.0f - (1.0f / TAIL_WIDTH) * distance, (vfloat)(0.0f));
}

// Mean kernel of the views that see a point. Views that are missing to floor_views say `unseen`; of a
// half-plane nothing.
static inline vfloat mean_kernel(vfloat sum, vfloat count, int min_views, float floor_views, float unseen) {
  if (HALF_PLANES) unseen = 0.0f;
  return score_of(sum + unseen * max(floor_views - count, (vfloat)(0.0f)), count, min_views,
                  floor_views);
}

#define INLINE static inline __attribute__((always_inline))

#if SLACK
// Length of the reference's gradient at LANES pixels; own: channel 0.
INLINE vfloat steepness(__global const float* own, int stride) {
  const vfloat gx = VLOAD(own + 3 * stride), gy = VLOAD(own + 4 * stride);
  return sqrt(gx * gx + gy * gy);
}
#endif

#if SHIFT_ALIKE

// Vectors beside a block that hold the columns of the last taps.
#define TAP_VECTORS ((3 + LANES - 1) / LANES)

// LANES columns of neighbouring vectors, from column 1, 2 or 3 on. Through memory it would take
// longer: a load that two stores have a part in waits for both.
#if LANES == 1
#define COLUMNS_FROM_1(columns) ((columns)[1])
#define COLUMNS_FROM_2(columns) ((columns)[2])
#define COLUMNS_FROM_3(columns) ((columns)[3])
#elif LANES == 4
#define COLUMNS_FROM_1(columns) ((vfloat)((columns)[0].yzw, (columns)[1].x))
#define COLUMNS_FROM_2(columns) ((vfloat)((columns)[0].zw, (columns)[1].xy))
#define COLUMNS_FROM_3(columns) ((vfloat)((columns)[0].w, (columns)[1].xyz))
#elif LANES == 8
#define COLUMNS_FROM_1(columns) \
  ((vfloat)((columns)[0].s1234, (columns)[0].s567, (columns)[1].s0))
#define COLUMNS_FROM_2(columns) \
  ((vfloat)((columns)[0].s2345, (columns)[0].s67, (columns)[1].s01))
#define COLUMNS_FROM_3(columns) \
  ((vfloat)((columns)[0].s3456, (columns)[0].s7, (columns)[1].s012))
#else
#define COLUMNS_FROM_1(columns) \
  ((vfloat)((columns)[0].s12345678, (columns)[0].s9abc, (columns)[0].sdef, (columns)[1].s0))
#define COLUMNS_FROM_2(columns) \
  ((vfloat)((columns)[0].s23456789, (columns)[0].sabcd, (columns)[0].sef, (columns)[1].s01))
#define COLUMNS_FROM_3(columns) \
  ((vfloat)((columns)[0].s3456789a, (columns)[0].sbcde, (columns)[0].sf, (columns)[1].s012))
#endif

// Where a view sees a block: units [first_unit, last_unit] of it are inside the picture at least in
// part; whole: all of them are.
typedef struct {
  int first_unit, last_unit, whole;
  int x, last_column;  // of the block's first pixel, of the picture
  __global const float *above, *row, *below, *below2;  // channel 0, column x
  float4 weights_u, weights_v;
  int between_columns, between_rows;  // 0: no interpolation needed
} BlockView;

static inline int see_block(__global const float* band, const BandParams p, int k,
                            const BlockShift shift, int x, int y, BlockView* view) {
  view->between_columns = shift.fraction_u > 0.0f;
  view->between_rows = shift.fraction_v > 0.0f;
  view->x = x;
  view->last_column = p.width - 1 - view->between_columns;
  if (y < 0 || y + view->between_rows > p.height - 1) return 0;
  if (x > view->last_column || x + UNITS * LANES <= 0) return 0;
  view->first_unit = x < 0 ? -x / LANES : 0;
  view->last_unit = min(UNITS - 1, (view->last_column - x) / LANES);
  view->whole = !MASKED & (x >= 0) & (x + UNITS * LANES - 1 <= view->last_column);
  view->row = band_row(band, p, k, y) + x;
  view->above = y > 0 ? band_row(band, p, k, y - 1) + x : view->row;
  view->below = y + 1 < p.height ? band_row(band, p, k, y + 1) + x : view->row;
  view->below2 = y + 2 < p.height ? band_row(band, p, k, y + 2) + x : view->below;
  view->weights_u = tap_weights(shift.fraction_u);
  view->weights_v = tap_weights(shift.fraction_v);
  return 1;
}

// A channel at LANES columns from x - 1 on, interpolated between rows.
INLINE vfloat columns_at(const BlockView* view, int x, int between_rows) {
  if (!between_rows) return VLOAD(view->row + x - 1);
  const float4 w = view->weights_v;
  return w.s0 * VLOAD(view->above + x - 1) + w.s1 * VLOAD(view->row + x - 1) +
         w.s2 * VLOAD(view->below + x - 1) + w.s3 * VLOAD(view->below2 + x - 1);
}

// The channels from `channel` on at units from `unit` on, without the last of the vectors that a unit's
// taps lie in.
#define TAP_WINDOW (TAP_VECTORS + 1)
INLINE void begin_window(const BlockView* view, int stride, int channel, int channels, int unit,
                         int between_rows, vfloat window[][TAP_WINDOW]) {
  UNROLL
  for (int c = 0; c < channels; ++c)
    UNROLL
    for (int t = 0; t < TAP_VECTORS; ++t)
      window[c][t] = columns_at(view, (channel + c) * stride + (unit + t) * LANES, between_rows);
}

// Squared distance of a unit's samples to `own`; the window goes on to the next unit.
INLINE vfloat distance2(const BlockView* view, __global const float* own, int stride, int channel,
                        int channels, int unit, int between_rows, int between_columns,
                        vfloat window[][TAP_WINDOW]) {
  const float4 w = view->weights_u;
  vfloat squared = (vfloat)(0.0f);
  UNROLL
  for (int c = 0; c < channels; ++c) {
    const int from = (channel + c) * stride + unit * LANES;
    vfloat* columns = window[c];
    columns[TAP_VECTORS] = columns_at(view, from + TAP_VECTORS * LANES, between_rows);
    vfloat value = COLUMNS_FROM_1(columns);
    if (between_columns)
      value = w.s0 * columns[0] + w.s1 * value + w.s2 * COLUMNS_FROM_2(columns) +
              w.s3 * COLUMNS_FROM_3(columns);
    const vfloat difference = value - VLOAD(own + from);
    squared += difference * difference;
    UNROLL
    for (int t = 0; t < TAP_VECTORS; ++t) columns[t] = columns[t + 1];
  }
  return squared;
}

typedef struct {
  float bandwidth, gradient_bandwidth, colour_slack, gradient_slack;
  float inverse_h, inverse_g, gradient_share;
} Kernels;

// Sums over the views, of all units under one hypothesis. The views that see the whole block are in
// `whole`, not in `counts`.
typedef struct {
  vfloat sums[PARTS][UNITS], counts[PARTS][UNITS];
  float whole[PARTS];
} BlockSums;

// Neighbouring units with something to do.
typedef struct {
  int first, last;
} Run;

// Adds one view's kernels of a run.
INLINE void add_run(const BlockView* view, const Run run, __global const float* own, int stride,
                    int member, const Kernels kernels, int between_rows, int between_columns,
                    BlockSums* block) {
  const int first = max(run.first, view->first_unit), last = min(run.last, view->last_unit);
  if (first > last) return;
  vfloat window[3][TAP_WINDOW], colour[UNITS];
  begin_window(view, stride, 0, 3, first, between_rows, window);
  vfloat largest = (vfloat)(0.0f);
  for (int j = first; j <= last; ++j) {
    const vfloat squared =
        distance2(view, own, stride, 0, 3, j, between_rows, between_columns, window);
#if SLACK
    const vfloat inverse_h = 1.0f / (kernels.bandwidth + kernels.colour_slack * steepness(own + j * LANES, stride));
#else
    const float inverse_h = kernels.inverse_h;
#endif
    colour[UNIT(j)] = tailed_kernel(sqrt(squared) * inverse_h);
    if (!view->whole) {
      const vint column = view->x + j * LANES + VLANES;
      vfloat inside =
          VSELECT((vfloat)(0.0f), (vfloat)(1.0f), column >= 0 && column <= view->last_column);
#if MASKED
      // Three channels beyond those of any picture.
      inside = VSELECT((vfloat)(0.0f), inside, squared < 12.0f);
#endif
      colour[UNIT(j)] *= inside;
      UNROLL
      for (int part = 0; part < PARTS; ++part)
        if (PARTS == 1 || member >> part & 1) block->counts[part][UNIT(j)] += inside;
    }
    largest = max(largest, colour[UNIT(j)]);
  }
  // Another colour is an occluder: its gradient is not asked for.
  if (!(largest_lane(largest) > 0.0f)) return;

  begin_window(view, stride, 3, CHANNELS - 3, first, between_rows, window);
  const float share = kernels.gradient_share;
  for (int j = first; j <= last; ++j) {
    const vfloat squared =
        distance2(view, own, stride, 3, CHANNELS - 3, j, between_rows, between_columns, window);
#if SLACK
    const vfloat inverse_g =
        1.0f / (kernels.gradient_bandwidth + kernels.gradient_slack * steepness(own + j * LANES, stride));
#else
    const float inverse_g = kernels.inverse_g;
#endif
    const vfloat gradient = max(1.0f - sqrt(squared) * inverse_g, (vfloat)(0.0f));
    const vfloat kernel_value = (1.0f - share) * colour[UNIT(j)] +
                                share * gradient * min(4.0f * colour[UNIT(j)], (vfloat)(1.0f));
    UNROLL
    for (int part = 0; part < PARTS; ++part)
      if (PARTS == 1 || member >> part & 1) block->sums[part][UNIT(j)] += kernel_value;
  }
}

__kernel void robust_score(__global const float* band, const BandParams p, const StripParams strip,
                           __global const float* own_band, const BandParams own_p,
                           const int own_view, __global const BlockShift* shifts,
                           const HypothesisParams hypotheses, __global const uchar* todo,
                           __global const ushort2* bounds, __global const uchar* members,
                           const float bandwidth, const float gradient_bandwidth,
                           const float gradient_share, const int min_views, const float floor_views,
                           const float unseen, const float colour_slack, const float gradient_slack,
                           __global float* scores, const int scores_begin) {
  const int u = get_global_id(0) * UNITS * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;

  int first = INT_MAX, last = -1;          // hypotheses
  int num_runs = 0;
  Run runs[(UNITS + 1) / 2];
  LaneBounds tested[UNITS];
  for (int j = 0; j < UNITS && u + j * LANES < strip.width; ++j) {
    const int2 unit = block_bounds(todo, bounds, strip, row, u + j * LANES, &tested[UNIT(j)]);
    if (unit.y < 0) continue;
    first = min(first, unit.x);
    last = max(last, unit.y);
    if (num_runs > 0 && runs[UNIT(num_runs - 1)].last == j - 1) {
      runs[UNIT(num_runs - 1)].last = j;
    } else {
      runs[UNIT(num_runs)] = (Run){j, j};
      ++num_runs;
    }
  }
  if (last < 0) return;

  __global const float* own = band_row(own_band, own_p, own_view, v) + u;
  const Kernels kernels = {bandwidth, gradient_bandwidth, colour_slack, gradient_slack,
                           1.0f / bandwidth, 1.0f / gradient_bandwidth, gradient_share};
  for (int begin = first; begin <= last; begin += TILE) {
    const int tile = min(TILE, last - begin + 1);
    BlockSums blocks[TILE];
    for (int i = 0; i < tile; ++i)
      for (int part = 0; part < PARTS; ++part) {
        blocks[TURN(i)].whole[part] = 0.0f;
        for (int j = 0; j < UNITS; ++j)
          blocks[TURN(i)].sums[part][UNIT(j)] = blocks[TURN(i)].counts[part][UNIT(j)] = (vfloat)(0.0f);
      }

    for (int k = 0; k < p.num_views; ++k) {
      const int member = members[k];
      if (!member) continue;
      for (int i = 0; i < tile; ++i) {
        const BlockShift shift = shifts[(size_t)(begin + i) * p.num_views + k];
        BlockView view;
        if (!see_block(band, p, k, shift, u + shift.whole_u, v + shift.whole_v, &view)) continue;
        BlockSums* block = &blocks[TURN(i)];
        if (view.whole)
          for (int part = 0; part < PARTS; ++part)
            block->whole[part] += PARTS == 1 || member >> part & 1;
        for (int r = 0; r < num_runs; ++r) {
          if (view.between_rows && view.between_columns)
            add_run(&view, runs[UNIT(r)], own, p.stride, member, kernels, 1, 1, block);
          else if (view.between_rows)
            add_run(&view, runs[UNIT(r)], own, p.stride, member, kernels, 1, 0, block);
          else if (view.between_columns)
            add_run(&view, runs[UNIT(r)], own, p.stride, member, kernels, 0, 1, block);
          else
            add_run(&view, runs[UNIT(r)], own, p.stride, member, kernels, 0, 0, block);
        }
      }
    }

    for (int i = 0; i < tile; ++i)
      for (int r = 0; r < num_runs; ++r)
        for (int j = runs[UNIT(r)].first; j <= runs[UNIT(r)].last; ++j) {
          const BlockSums* block = &blocks[TURN(i)];
          vfloat score = (vfloat)(-1.0f);
          for (int part = 0; part < PARTS; ++part)
            score = max(score, mean_kernel(block->sums[part][UNIT(j)],
                                           block->whole[part] + block->counts[part][UNIT(j)],
                                           min_views, floor_views, unseen));
          store_scores(scores + score_index(strip, hypotheses, v - scores_begin, u + j * LANES), hypotheses,
                       &tested[UNIT(j)], begin + i, score);
        }
  }
  for (int r = 0; r < num_runs; ++r)
    for (int j = runs[UNIT(r)].first; j <= runs[UNIT(r)].last; ++j)
      repeat_ends_of_lanes(scores + score_index(strip, hypotheses, v - scores_begin, u + j * LANES), hypotheses,
                           &tested[UNIT(j)]);
}

#else

__kernel void robust_score(__global const float* taps, const BandParams p, const StripParams strip,
                           __global const float* own_band, const BandParams own_p,
                           const int own_view, __global const float* rays,
                           const HypothesisParams hypotheses, __global const uchar* todo,
                           __global const ushort2* bounds, __global const uchar* members,
                           const float bandwidth, const float gradient_bandwidth,
                           const float gradient_share, const int min_views, const float floor_views,
                           const float unseen, const float colour_slack, const float gradient_slack,
                           __global float* scores, const int scores_begin) {
  const int row = get_global_id(1), v = strip.row_begin + row;
  for (int j = 0; j < UNITS; ++j) {
    const int u = (get_global_id(0) * UNITS + j) * LANES;
    if (u >= strip.width) return;
    LaneBounds tested;
    const int2 block = block_bounds(todo, bounds, strip, row, u, &tested);
    if (block.y < 0) continue;

    vfloat own[CHANNELS];
    __global const float* here = band_row(own_band, own_p, own_view, v) + u;
    UNROLL
    for (int c = 0; c < CHANNELS; ++c) own[c] = VLOAD(here + c * p.stride);
#if SLACK
    const vfloat steep = steepness(here, p.stride);
    const vfloat inverse_h = 1.0f / (bandwidth + colour_slack * steep);
    const vfloat inverse_g = 1.0f / (gradient_bandwidth + gradient_slack * steep);
#else
    const float inverse_h = 1.0f / bandwidth, inverse_g = 1.0f / gradient_bandwidth;
    (void)inverse_g;  // with three channels
#endif
    __global float* column = scores + score_index(strip, hypotheses, v - scores_begin, u);
    for (int i = block.x; i <= block.y; ++i) {
      const float h = hypotheses.min + i * hypotheses.step;
      vfloat sums[PARTS], counts[PARTS];
      for (int part = 0; part < PARTS; ++part) sums[part] = counts[part] = (vfloat)(0.0f);
      for (int k = 0; k < p.num_views; ++k) {
        if (!members[k]) continue;
        LanePlaces at;
        locate_lanes(rays, k, PIXELS_FROM(u), (vfloat)(v), h, &at);
        vfloat sample[CHANNELS], inside;
        if (!sample_lanes(taps, p, k, at.x, at.y, sample, &inside)) continue;
        vfloat squared = (vfloat)(0.0f);
        UNROLL
        for (int c = 0; c < 3; ++c) squared += (sample[c] - own[c]) * (sample[c] - own[c]);
        const vfloat colour = inside * tailed_kernel(sqrt(squared) * inverse_h);
        UNROLL
        for (int part = 0; part < PARTS; ++part)
          if (PARTS == 1 || members[k] >> part & 1) counts[part] += inside;
        // Another colour is an occluder: its gradient is not asked for.
        if (!(largest_lane(colour) > 0.0f)) continue;
        vfloat kernel_value = (1.0f - gradient_share) * colour;
#if CHANNELS > 3
        const vfloat gx = sample[3] * at.x_u + sample[4] * at.y_u - own[3];
        const vfloat gy = sample[3] * at.x_v + sample[4] * at.y_v - own[4];
        const vfloat gradient = max(1.0f - sqrt(gx * gx + gy * gy) * inverse_g, (vfloat)(0.0f));
        kernel_value += gradient_share * gradient * min(4.0f * colour, (vfloat)(1.0f));
#endif
        UNROLL
        for (int part = 0; part < PARTS; ++part)
          if (PARTS == 1 || members[k] >> part & 1) sums[part] += kernel_value;
      }
      vfloat score = mean_kernel(sums[0], counts[0], min_views, floor_views, unseen);
      for (int part = 1; part < PARTS; ++part)
        score = max(score, mean_kernel(sums[part], counts[part], min_views, floor_views, unseen));
      store_scores(column, hypotheses, &tested, i, score);
    }
    repeat_ends_of_lanes(column, hypotheses, &tested);
  }
}

#endif
