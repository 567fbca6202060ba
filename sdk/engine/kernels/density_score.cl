// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Density score (eq. 3-5): how densely the colours that all views see under a hypothesis lie around
// the mean that mean-shift finds from the reference pixel's colour; Epanechnikov kernel.
//   band    [row][view][channel][stride]
//   todo    [v][pitch] bytes, 0: nothing to do; a block of LANES zeros costs nothing
//   bounds  [v][pitch] (first, last) hypothesis to test
//   ways    SHIFT_ALIKE 1: [hypothesis][view], from block_shifts; 0: the ray table
//   source  where samples come from: the band, or its taps (SHIFT_ALIKE 0)
//   scores  [v - scores_begin][u][hypothesis]; -1 where too few views see the point. Hypotheses outside the
//           union of a block's bounds are not written.
//   staged  local memory, 4 vectors per view: the samples, read once and used by every mean-shift
//           iteration (STAGE 1: CPUs; with STAGE 0 they are fetched again each time)
// One work-item per (block of LANES pixels, row).

#ifndef ITERATIONS
#define ITERATIONS 10  // mean-shift iterations before the score (eq. 5); 0: none
#endif
#ifndef MASKED
#define MASKED 0  // 1: some pixels of the band are masked, samples of them count for nothing
#endif
#ifndef STAGE
#define STAGE 1
#endif
#ifndef MOVE_BOUND
// Mean-shift of a pixel stops when it moves by no more than this share of the bandwidth. A score then
// changes by less than 2 * MOVE_BOUND * ITERATIONS (the slope of the kernel is at most 2 / h); 0: only
// when nothing moves at all, which gives the same bits as all iterations.
#define MOVE_BOUND 1e-4f
#endif

// A sample of a view as mean-shift wants it: the colour relative to the pixel's own, in units of the
// bandwidth, and its squared length. With them the kernel around a mean m (in the same units) is
//   1 - |x - m|^2 = (1 - |m|^2) - |x|^2 + 2 m x
// which takes fewer operations than differences do, and nothing cancels: m starts at 0 and moves by
// less than 1 in an iteration.
typedef struct {
  vfloat red, green, blue, length2;
} Sample;

// A squared length that no kernel reaches stands for "not inside the picture".
#define FAR_AWAY 1e8f

static inline Sample relative_sample(const vfloat* colour, vfloat inside, const vfloat* own,
                                     float inverse_h) {
  Sample sample;
  sample.red = (colour[0] - own[0]) * inverse_h;
  sample.green = (colour[1] - own[1]) * inverse_h;
  sample.blue = (colour[2] - own[2]) * inverse_h;
  const vfloat length2 =
      sample.red * sample.red + sample.green * sample.green + sample.blue * sample.blue;
  sample.length2 = VSELECT((vfloat)(FAR_AWAY), length2, inside > 0.0f);
  return sample;
}

#if SHIFT_ALIKE
typedef BlockShift Way;
#define WAYS_OF(ways, i, num_views) ((ways) + (size_t)(i) * (num_views))
#else
typedef float Way;
#define WAYS_OF(ways, i, num_views) (ways)
#endif

// Sample of view k of LANES pixels from (u, v) under hypothesis h; adds 1 to count in lanes where it
// sees something.
static inline Sample take_sample(__global const float* source, const BandParams p, int k,
                                 __global const Way* ways, int u, int v, float h,
                                 const vfloat* own, float inverse_h, vfloat* count) {
  const Sample nothing = {0.0f, 0.0f, 0.0f, FAR_AWAY};
  vfloat inside, colour[CHANNELS];
#if SHIFT_ALIKE
  BlockPosition at;
  if (!place_block(p, ways[k], u, v, &at, &inside)) return nothing;
  sample_block(source, p, k, at, 0, 3, colour);
#if MASKED
  inside = VSELECT((vfloat)(0.0f), inside, fabs(colour[0] - 0.5f) <= MASKED_BEYOND);
#endif
#else
  LanePlaces at;
  locate_lanes(ways, k, PIXELS_FROM(u), (vfloat)(v), h, &at);
  if (!sample_lanes(source, p, k, at.x, at.y, colour, &inside)) return nothing;
#endif
  *count += inside;
  return relative_sample(colour, inside, own, inverse_h);
}

// What the kernels of all samples have in common.
typedef struct {
  vfloat offset, red, green, blue;  // 1 - |m|^2, 2 m
} Mean;

// Epanechnikov kernel (eq. 4) of a sample around a mean.
static inline vfloat epanechnikov(const Sample x, const Mean m) {
  return max(m.red * x.red + (m.green * x.green + (m.blue * x.blue + (m.offset - x.length2))),
             (vfloat)(0.0f));
}

// Sums of the kernels, and of the samples weighed by them, that a mean-shift step needs.
typedef struct {
  vfloat weights, red, green, blue;
} MeanShiftSums;

static inline void add_sample(MeanShiftSums* sums, const Sample x, vfloat w) {
  sums->weights += w;
  sums->red += w * x.red;
  sums->green += w * x.green;
  sums->blue += w * x.blue;
}

// Mean-shift step (eq. 5); where no sample is near, the mean stays. Lanes that moved by MOVE_BOUND or
// less come to rest, whatever their neighbours do. moving: 1 for the others. Returns 0 when none moves.
static inline int move(Mean* mean, const MeanShiftSums sums, vfloat* moving) {
  const vfloat scale = 2.0f / max(sums.weights, (vfloat)(1e-12f));
  const vfloat pull = sums.weights * *moving;
  const vfloat red = VSELECT(mean->red, sums.red * scale, pull > 0.0f);
  const vfloat green = VSELECT(mean->green, sums.green * scale, pull > 0.0f);
  const vfloat blue = VSELECT(mean->blue, sums.blue * scale, pull > 0.0f);
  const vfloat dr = red - mean->red, dg = green - mean->green, db = blue - mean->blue;
  const vfloat moved2 = dr * dr + dg * dg + db * db;
  mean->red = red;
  mean->green = green;
  mean->blue = blue;
  mean->offset = 1.0f - 0.25f * (red * red + green * green + blue * blue);
  *moving = VSELECT((vfloat)(0.0f), (vfloat)(1.0f), moved2 > 4 * MOVE_BOUND * MOVE_BOUND);
  return largest_lane(*moving) > 0.0f;
}

static inline void stage(__local vfloat* staged, int k, const Sample x) {
  staged[SLICE(4 * k)] = x.red;
  staged[SLICE(4 * k + 1)] = x.green;
  staged[SLICE(4 * k + 2)] = x.blue;
  staged[SLICE(4 * k + 3)] = x.length2;
}

static inline Sample staged_sample(__local const vfloat* staged, int k) {
  const Sample x = {staged[SLICE(4 * k)], staged[SLICE(4 * k + 1)], staged[SLICE(4 * k + 2)],
                    staged[SLICE(4 * k + 3)]};
  return x;
}

// STAGE 1: what the first iteration stored; else taken again.
static inline Sample sample_again(__local const vfloat* staged, __global const float* source,
                                  const BandParams p, int k, __global const Way* ways, int u, int v,
                                  float h, const vfloat* own, float inverse_h) {
#if STAGE
  return staged_sample(staged, k);
#else
  vfloat ignored = (vfloat)(0.0f);
  return take_sample(source, p, k, ways, u, v, h, own, inverse_h, &ignored);
#endif
}
// Sum of the kernels around the mean that mean-shift finds. sums: of the first iteration.
static inline vfloat mean_shift_density(__local const vfloat* staged, __global const float* source,
                                        const BandParams p, __global const Way* ways, int u, int v,
                                        float h, const vfloat* own, float inverse_h,
                                        MeanShiftSums sums) {
  Mean mean = {1.0f, 0.0f, 0.0f, 0.0f};
  vfloat moving = (vfloat)(1.0f);
  for (int iteration = 0; iteration < ITERATIONS; ++iteration) {
    if (iteration > 0) {
      // Two sets of sums: one would leave the units waiting for the addition before.
      MeanShiftSums even = {0.0f, 0.0f, 0.0f, 0.0f}, odd = {0.0f, 0.0f, 0.0f, 0.0f};
      int k = 0;
      for (; k + 1 < p.num_views; k += 2) {
        const Sample x = sample_again(staged, source, p, k, ways, u, v, h, own, inverse_h);
        add_sample(&even, x, epanechnikov(x, mean));
        const Sample y = sample_again(staged, source, p, k + 1, ways, u, v, h, own, inverse_h);
        add_sample(&odd, y, epanechnikov(y, mean));
      }
      if (k < p.num_views) {
        const Sample x = sample_again(staged, source, p, k, ways, u, v, h, own, inverse_h);
        add_sample(&even, x, epanechnikov(x, mean));
      }
      sums.weights = even.weights + odd.weights;
      sums.red = even.red + odd.red;
      sums.green = even.green + odd.green;
      sums.blue = even.blue + odd.blue;
    }
    if (!move(&mean, sums, &moving)) break;
  }
  vfloat density = (vfloat)(0.0f);
  for (int k = 0; k < p.num_views; ++k)
    density += epanechnikov(sample_again(staged, source, p, k, ways, u, v, h, own, inverse_h), mean);
  return density;
}

__kernel void density_score(__global const float* band, __global const float* source,
                            const BandParams p, const StripParams strip, __global const Way* ways,
                            const HypothesisParams hypotheses,
                            __global const uchar* todo, __global const ushort2* bounds,
                            const float bandwidth, const int min_views, const float floor_views, __global float* scores,
                            const int scores_begin, __local vfloat* staged) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;

  LaneBounds tested;
  const int2 block = block_bounds(todo, bounds, strip, row, u, &tested);
  const int first = block.x, last = block.y;
  if (last < 0) return;

  vfloat own[3];
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  UNROLL
  for (int c = 0; c < 3; ++c) own[c] = VLOAD(here + c * p.stride);
  const float inverse_h = 1.0f / bandwidth;

  __global float* column = scores + score_index(strip, hypotheses, v - scores_begin, u);
  for (int i = first; i <= last; ++i) {
    __global const Way* here_ways = WAYS_OF(ways, i, p.num_views);
    const float h = hypotheses.min + i * hypotheses.step;
    vfloat count = (vfloat)(0.0f);
    // The first iteration goes with taking the samples: around the pixel's own colour.
    MeanShiftSums sums = {0.0f, 0.0f, 0.0f, 0.0f};
    for (int k = 0; k < p.num_views; ++k) {
      const Sample x = take_sample(source, p, k, here_ways, u, v, h, own, inverse_h, &count);
#if STAGE
      stage(staged, k, x);
#endif
      add_sample(&sums, x, max(1.0f - x.length2, (vfloat)(0.0f)));
    }
    const vfloat density =
        mean_shift_density(staged, source, p, here_ways, u, v, h, own, inverse_h, sums);
    store_scores(column, hypotheses, &tested, i,
                 score_of(density, count, min_views, floor_views));
  }
  repeat_ends_of_lanes(column, hypotheses, &tested);
}

#if STAGE && !CUBIC && LANES > 1 && SHIFT_ALIKE
// The same for pixels that stand alone, LANES of them together: most pixels of a view are known already
// when its turn comes. The samples are fetched one by one; what follows is the same arithmetic, and
// every pixel gets the same bits.
//   packed  [pixel][2] row (counted from the strip's first), column
//   places  [rows + 1] from pack_lonely; the last is the number of pixels
// One work-item per block of LANES pixels, the last pixel again in lanes beyond the end.
__kernel void density_score_packed(
    __global const float* band, const BandParams p, const StripParams strip,
    __global const BlockShift* shifts, const HypothesisParams hypotheses,
    __global const int* packed, __global const int* places, __global const ushort2* bounds,
    const float bandwidth, const int min_views, const float floor_views, __global float* scores,
    const int scores_begin, __local vfloat* staged) {
  const int first_row = strip.row_begin - scores_begin;
  const int begin = get_global_id(0) * LANES, size = places[strip.row_end - strip.row_begin];
  if (begin >= size) return;
  int rows[LANES], columns[LANES];
  for (int lane = 0; lane < LANES; ++lane) {
    const int i = min(begin + lane, size - 1);
    rows[lane] = packed[2 * i];
    columns[lane] = packed[2 * i + 1];
  }

  int first = hypotheses.count, last = -1;
  ushort2 tested[LANES];
  float own[3][LANES];
  for (int lane = 0; lane < LANES; ++lane) {
    tested[lane] = bounds[view_index(strip, rows[lane], columns[lane])];
    first = min(first, (int)tested[lane].x);
    last = max(last, (int)tested[lane].y);
    __global const float* here =
        band_row(band, p, strip.ref, strip.row_begin + rows[lane]) + columns[lane];
    for (int c = 0; c < 3; ++c) own[c][lane] = here[c * p.stride];
  }
  const vfloat own_colour[3] = {VLOAD(own[0]), VLOAD(own[1]), VLOAD(own[2])};
  const vint u = CONCAT(vload, LANES)(0, columns);
  const vint v = CONCAT(vload, LANES)(0, rows) + strip.row_begin;
  const float inverse_h = 1.0f / bandwidth;

  for (int i = first; i <= last; ++i) {
    __global const BlockShift* shift = shifts + (size_t)i * p.num_views;
    for (int k = 0; k < p.num_views; ++k) {
      const float fx = shift[k].fraction_u, fy = shift[k].fraction_v;
      const int last_column = p.width - 1 - (fx > 0.0f), last_row = p.height - 1 - (fy > 0.0f);
      __local float* red = (__local float*)(staged + SLICE(4 * k));
      __local float* green = (__local float*)(staged + SLICE(4 * k + 1));
      __local float* blue = (__local float*)(staged + SLICE(4 * k + 2));
      for (int lane = 0; lane < LANES; ++lane) {
        const int x = columns[lane] + shift[k].whole_u;
        const int y = strip.row_begin + rows[lane] + shift[k].whole_v;
        float colour[3] = {0.0f, 0.0f, 0.0f};
        if (x >= 0 && x <= last_column && y >= 0 && y <= last_row) {
          __global const float* from = band_row(band, p, k, y) + x;
          UNROLL
          for (int c = 0; c < 3; ++c) {
            const float2 pair = vload2(0, from + c * p.stride);
            colour[c] = pair.x + fx * (pair.y - pair.x);
          }
          if (fy > 0.0f) {
            __global const float* below = band_row(band, p, k, y + 1) + x;
            UNROLL
            for (int c = 0; c < 3; ++c) {
              const float2 pair = vload2(0, below + c * p.stride);
              colour[c] += fy * (pair.x + fx * (pair.y - pair.x) - colour[c]);
            }
          }
        }
        red[lane] = colour[0];
        green[lane] = colour[1];
        blue[lane] = colour[2];
      }
    }
    vfloat count = (vfloat)(0.0f);
    MeanShiftSums sums = {0.0f, 0.0f, 0.0f, 0.0f};
    for (int k = 0; k < p.num_views; ++k) {
      const vint x = u + shift[k].whole_u, y = v + shift[k].whole_v;
      const vint last_column = p.width - 1 - (shift[k].fraction_u > 0.0f);
      const vint last_row = p.height - 1 - (shift[k].fraction_v > 0.0f);
      vfloat inside = VSELECT((vfloat)(0.0f), (vfloat)(1.0f),
                              x >= 0 && x <= last_column && y >= 0 && y <= last_row);
      const vfloat colour[3] = {staged[SLICE(4 * k)], staged[SLICE(4 * k + 1)],
                                staged[SLICE(4 * k + 2)]};
#if MASKED
      inside = VSELECT((vfloat)(0.0f), inside, fabs(colour[0] - 0.5f) <= MASKED_BEYOND);
#endif
      const Sample sample = relative_sample(colour, inside, own_colour, inverse_h);
      count += inside;
      stage(staged, k, sample);
      add_sample(&sums, sample, max(1.0f - sample.length2, (vfloat)(0.0f)));
    }
    const vfloat density =
        mean_shift_density(staged, band, p, shift, 0, 0, 0.0f, own_colour, inverse_h, sums);
    float score[LANES];
    VSTORE(score_of(density, count, min_views, floor_views), score);
    for (int lane = 0; lane < LANES; ++lane)
      if (i >= tested[lane].x && i <= tested[lane].y)
        scores[score_index(strip, hypotheses, first_row + rows[lane], columns[lane]) + i] = score[lane];
  }
  for (int lane = 0; lane < LANES; ++lane)
    repeat_ends(scores + score_index(strip, hypotheses, first_row + rows[lane], columns[lane]), hypotheses,
                tested[lane].x, tested[lane].y);
}
#endif
