// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Robust score: triangle kernels of colour and of the gradient around the reference pixel's own values,
//   K = (1 - share) Kc + share Kg min(1, 4 Kc),
// averaged over the views. The gate keeps an occluder of another colour from scoring by its gradient.
//   band    [row][view][5][stride]: RGB, gx, gy
//   members [view] bit 0: the view counts; HALF_PLANES 1: bit i: it lies in half-plane i of the camera
//           positions (view_sets.h)
//   own     the reference view: view own_view of a band with parameters own_p
//   others as for density_score
// HALF_PLANES 1: the largest of the averages over the 8 half-planes; a point beside a silhouette is
// hidden from one side only.
// One work-item per (block of UNITS * LANES pixels, row): what is interpolated between rows serves all
// pixels of a block. SHIFT_ALIKE 0: samples come from taps, and gradients are turned into the axes of
// the reference view.

#ifndef UNITS
#define UNITS 1
#endif
#ifndef MASKED
#define MASKED 0  // 1: some pixels of the band are masked, samples of them count for nothing
#endif
#ifndef HALF_PLANES
#define HALF_PLANES 0
#endif
#if HALF_PLANES
#define PARTS 8
#else
#define PARTS 1
#endif
// Vectors beside a block that hold the columns of the last taps.
#define TAP_VECTORS ((3 + LANES - 1) / LANES)

#if SHIFT_ALIKE

static inline float4 tap_weights(float f) {
#if CUBIC
  return cubic_weights(f);
#else
  return (float4)(0.0f, 1.0f - f, f, 0.0f);
#endif
}

// Where a view sees a block: units [first, last] of it are inside the picture at least in part.
typedef struct {
  int first, last;
  __global const float *above, *row, *below, *below2;  // channel 0, column of the block's first pixel
  float4 weights_u, weights_v;
  int between_columns, between_rows;  // 0: no interpolation needed
} BlockView;

static inline int see_block(__global const float* band, const BandParams p, int k,
                            const BlockShift shift, int x, int y, BlockView* view) {
  view->between_columns = shift.fraction_u > 0.0f;
  view->between_rows = shift.fraction_v > 0.0f;
  const int last_column = p.width - 1 - view->between_columns;
  if (y < 0 || y + view->between_rows > p.height - 1) return 0;
  if (x > last_column || x + UNITS * LANES <= 0) return 0;
  view->first = x < 0 ? -x / LANES : 0;
  view->last = min(UNITS - 1, (last_column - x) / LANES);
  const size_t next = (size_t)p.num_views * CHANNELS * p.stride;
  view->row = band_row(band, p, k, y) + x;
  view->above = y > 0 ? view->row - next : view->row;
  view->below = y + 1 < p.height ? view->row + next : view->row;
  view->below2 = y + 2 < p.height ? view->below + next : view->below;
  view->weights_u = tap_weights(shift.fraction_u);
  view->weights_v = tap_weights(shift.fraction_v);
  return 1;
}

// Samples of a channel (offset: its first float) from `from`, squared differences to `own`, added up.
#define ADD_DIFFERENCES(from)                                                                  \
  UNROLL for (int j = 0; j < UNITS; ++j) {                                                     \
    if (j < view->first || j > view->last) continue;                                           \
    vfloat value = VLOAD((from) + j * LANES);                                                  \
    if (view->between_columns)                                                                 \
      value = view->weights_u.s0 * VLOAD((from) + j * LANES - 1) + view->weights_u.s1 * value + \
              view->weights_u.s2 * VLOAD((from) + j * LANES + 1) +                             \
              view->weights_u.s3 * VLOAD((from) + j * LANES + 2);                              \
    const vfloat difference = value - VLOAD(own + offset + j * LANES);                         \
    squared[j] += difference * difference;                                                     \
  }

static inline __attribute__((always_inline)) void add_differences(const BlockView* view,
                                                                  __global const float* own,
                                                                  int offset, vfloat* squared) {
  if (!view->between_rows) {
    ADD_DIFFERENCES(view->row + offset)
    return;
  }
  float columns[(UNITS + TAP_VECTORS) * LANES];  // from one left of the block on
  const float4 w = view->weights_v;
  for (int j = view->first; j <= view->last + TAP_VECTORS; ++j) {
    const int x = offset + j * LANES - 1;
    VSTORE(w.s0 * VLOAD(view->above + x) + w.s1 * VLOAD(view->row + x) +
               w.s2 * VLOAD(view->below + x) + w.s3 * VLOAD(view->below2 + x),
           columns + j * LANES);
  }
  ADD_DIFFERENCES(columns + 1)
}

__kernel void robust_score(__global const float* band, const BandParams p, const StripParams strip,
                           __global const float* own_band, const BandParams own_p,
                           const int own_view, __global const BlockShift* shifts,
                           const HypothesisParams hypotheses, __global const uchar* todo,
                           __global const ushort2* bounds, __global const uchar* members, const float bandwidth,
                           const float gradient_bandwidth, const float gradient_share,
                           const int min_views, const float floor_views, __global float* scores) {
  const int u = get_global_id(0) * UNITS * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;

  int first = INT_MAX, last = -1;
  LaneBounds tested[UNITS];
  for (int j = 0; j < UNITS && u + j * LANES < strip.width; ++j) {
    const int2 unit = block_bounds(todo, bounds, strip, row, u + j * LANES, &tested[j]);
    first = min(first, unit.x);
    last = max(last, unit.y);
  }
  if (last < 0) return;

  __global const float* own = band_row(own_band, own_p, own_view, v) + u;
  const float inverse_h = 1.0f / bandwidth, inverse_g = 1.0f / gradient_bandwidth;
  for (int i = first; i <= last; ++i) {
    __global const BlockShift* shift = shifts + (size_t)i * p.num_views;
    vfloat sums[PARTS][UNITS], counts[PARTS][UNITS];
    for (int part = 0; part < PARTS; ++part)
      for (int j = 0; j < UNITS; ++j) sums[part][j] = counts[part][j] = (vfloat)(0.0f);

    for (int k = 0; k < p.num_views; ++k) {
      if (!members[k]) continue;
      BlockView view;
      const int x = u + shift[k].whole_u;
      if (!see_block(band, p, k, shift[k], x, v + shift[k].whole_v, &view)) continue;
      const int last_column = p.width - 1 - view.between_columns;

      vfloat squared[UNITS], colour[UNITS];
      UNROLL
      for (int j = 0; j < UNITS; ++j) squared[j] = (vfloat)(0.0f);
      for (int c = 0; c < 3; ++c) add_differences(&view, own, c * p.stride, squared);
      vfloat largest = (vfloat)(0.0f);
      UNROLL
      for (int j = 0; j < UNITS; ++j) {
        if (j < view.first || j > view.last) continue;
        const vint column = x + j * LANES + VLANES;
        vfloat inside =
            VSELECT((vfloat)(0.0f), (vfloat)(1.0f), column >= 0 && column <= last_column);
#if MASKED
        // Three channels beyond those of any picture.
        inside = VSELECT((vfloat)(0.0f), inside, squared[j] < 12.0f);
#endif
        colour[j] = inside * max(1.0f - sqrt(squared[j]) * inverse_h, (vfloat)(0.0f));
        largest = max(largest, colour[j]);
        UNROLL
        for (int part = 0; part < PARTS; ++part)
          if (PARTS == 1 || members[k] >> part & 1) counts[part][j] += inside;
      }
      // Another colour is an occluder: its gradient is not asked for.
      if (!(largest_lane(largest) > 0.0f)) continue;

      UNROLL
      for (int j = 0; j < UNITS; ++j) squared[j] = (vfloat)(0.0f);
      for (int c = 3; c < CHANNELS; ++c) add_differences(&view, own, c * p.stride, squared);
      UNROLL
      for (int j = 0; j < UNITS; ++j) {
        if (j < view.first || j > view.last) continue;
        const vfloat gradient = max(1.0f - sqrt(squared[j]) * inverse_g, (vfloat)(0.0f));
        const vfloat kernel_value = (1.0f - gradient_share) * colour[j] +
                                    gradient_share * gradient * min(4.0f * colour[j], (vfloat)(1.0f));
        UNROLL
        for (int part = 0; part < PARTS; ++part)
          if (PARTS == 1 || members[k] >> part & 1) sums[part][j] += kernel_value;
      }
    }

    for (int j = 0; j < UNITS && u + j * LANES < strip.width; ++j) {
      vfloat score = score_of(sums[0][j], counts[0][j], min_views, floor_views);
      for (int part = 1; part < PARTS; ++part)
        score = max(score, score_of(sums[part][j], counts[part][j], min_views, floor_views));
      store_scores(scores + score_index(strip, hypotheses, row, u + j * LANES), hypotheses,
                   &tested[j], i, score);
    }
  }
  for (int j = 0; j < UNITS && u + j * LANES < strip.width; ++j)
    repeat_ends_of_lanes(scores + score_index(strip, hypotheses, row, u + j * LANES), hypotheses,
                         &tested[j]);
}

#else

__kernel void robust_score(__global const float* taps, const BandParams p, const StripParams strip,
                           __global const float* own_band, const BandParams own_p,
                           const int own_view, __global const float* rays,
                           const HypothesisParams hypotheses, __global const uchar* todo,
                           __global const ushort2* bounds, __global const uchar* members,
                           const float bandwidth, const float gradient_bandwidth,
                           const float gradient_share, const int min_views, const float floor_views,
                           __global float* scores) {
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
    const float inverse_h = 1.0f / bandwidth;
    __global float* column = scores + score_index(strip, hypotheses, row, u);
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
        const vfloat colour = inside * max(1.0f - sqrt(squared) * inverse_h, (vfloat)(0.0f));
        UNROLL
        for (int part = 0; part < PARTS; ++part)
          if (PARTS == 1 || members[k] >> part & 1) counts[part] += inside;
        // Another colour is an occluder: its gradient is not asked for.
        if (!(largest_lane(colour) > 0.0f)) continue;
        vfloat kernel_value = (1.0f - gradient_share) * colour;
#if CHANNELS > 3
        const vfloat gx = sample[3] * at.x_u + sample[4] * at.y_u - own[3];
        const vfloat gy = sample[3] * at.x_v + sample[4] * at.y_v - own[4];
        const vfloat gradient = max(1.0f - sqrt(gx * gx + gy * gy) / gradient_bandwidth, (vfloat)(0.0f));
        kernel_value += gradient_share * gradient * min(4.0f * colour, (vfloat)(1.0f));
#endif
        UNROLL
        for (int part = 0; part < PARTS; ++part)
          if (PARTS == 1 || members[k] >> part & 1) sums[part] += kernel_value;
      }
      vfloat score = score_of(sums[0], counts[0], min_views, floor_views);
      for (int part = 1; part < PARTS; ++part)
        score = max(score, score_of(sums[part], counts[part], min_views, floor_views));
      store_scores(column, hypotheses, &tested, i, score);
    }
    repeat_ends_of_lanes(column, hypotheses, &tested);
  }
}

#endif
