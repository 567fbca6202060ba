// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Density score (eq. 3-5): how densely the colours that all views see under a hypothesis lie around
// the reference pixel's colour.
//   band    [row][view][channel][stride]
//   todo    [row][pitch] bytes, 0: nothing to do; a block of LANES zeros costs nothing
//   bounds  [row][pitch] (first, last) hypothesis to test
//   scores  [row][hypothesis][pitch]; -1 where too few views see the point. Hypotheses outside the
//           union of a block's bounds are not written.
//   staged  local memory, 3 vectors per view: the samples, read once and used by every mean-shift
//           iteration (STAGE 1: CPUs; with STAGE 0 they are fetched again each time)
// One work-item per (block of LANES pixels, row).

#ifndef ITERATIONS
#define ITERATIONS 10  // mean-shift iterations before the score (eq. 5); 0: none
#endif
#ifndef GRADIENT
#define GRADIENT 0  // 1: triangle kernels of colour and gradient; 0: Epanechnikov kernel of colour
#endif
#ifndef STAGE
#define STAGE 1
#endif
#ifndef MOVE_BOUND
// Mean-shift stops when no lane moves by more than this share of the bandwidth. A score then changes
// by less than 2 * MOVE_BOUND * ITERATIONS (the slope of the kernel is at most 2 / h); 0: only when
// nothing moves at all, which gives the same bits as all iterations.
#define MOVE_BOUND 1e-4f
#endif

// A colour that no kernel reaches stands for "not inside the picture".
#define FAR_AWAY 1e4f

// Colours of view k under a hypothesis; FAR_AWAY where it sees nothing. Adds to count where it does.
static inline void sample_or_far(__global const float* band, const BandParams p,
                          __global const float* views, int ref, int k, int u, int v, float h,
                          vfloat* colour, vfloat* count) {
  vfloat inside;
  if (sample_lanes(band, p, views, ref, k, u, v, h, colour, &inside)) {
    *count += inside;
    colour[0] = VSELECT((vfloat)(FAR_AWAY), colour[0], inside > 0.0f);
  } else {
    colour[0] = colour[1] = colour[2] = (vfloat)(FAR_AWAY);
  }
}

// Epanechnikov kernel (eq. 4) of a colour around a mean.
static inline vfloat epanechnikov(vfloat red, vfloat green, vfloat blue, const vfloat* mean,
                           float inverse_h2) {
  const vfloat r = red - mean[0], g = green - mean[1], b = blue - mean[2];
  return max(1.0f - (r * r + g * g + b * b) * inverse_h2, (vfloat)(0.0f));
}

// Sums of the kernels, and of the colours weighed by them, that a mean-shift step needs.
typedef struct {
  vfloat weights, red, green, blue;
} MeanShiftSums;

static inline void add_sample(MeanShiftSums* sums, vfloat red, vfloat green, vfloat blue,
                       const vfloat* mean, float inverse_h2) {
  const vfloat w = epanechnikov(red, green, blue, mean, inverse_h2);
  sums->weights += w;
  sums->red += w * red;
  sums->green += w * green;
  sums->blue += w * blue;
}

__kernel void density_score(__global const float* band, const BandParams p, const StripParams strip,
                            __global const float* views, const HypothesisParams hypotheses,
                            __global const uchar* todo, __global const ushort2* bounds,
                            const float bandwidth, const float gradient_bandwidth,
                            const float gradient_share, const int min_views,
                            const float floor_views, __global float* scores, __local vfloat* staged) {
  const int u = get_global_id(0) * LANES, row = get_global_id(1);
  if (u >= strip.width) return;
  const int v = strip.row_begin + row;

  int first = hypotheses.count, last = -1;
  for (int lane = 0; lane < LANES; ++lane) {
    const size_t i = map_index(strip, row, u + lane);
    if (todo[i]) {
      first = min(first, (int)bounds[i].x);
      last = max(last, (int)bounds[i].y);
    }
  }
  if (last < 0) return;

  vfloat own[CHANNELS];
  __global const float* here = band_row(band, p, strip.ref, v) + u;
  for (int c = 0; c < CHANNELS; ++c) own[c] = VLOAD(here + c * p.stride);

  for (int i = first; i <= last; ++i) {
    const float h = hypotheses.min + i * hypotheses.step;
    vfloat count = (vfloat)(0.0f), density = (vfloat)(0.0f);
    vfloat colour[CHANNELS];
#if GRADIENT
    vfloat inside;
    const float inverse_h = 1.0f / bandwidth, inverse_g = 1.0f / gradient_bandwidth;
    for (int k = 0; k < p.num_views; ++k) {
      if (!sample_lanes(band, p, views, strip.ref, k, u, v, h, colour, &inside)) continue;
      count += inside;
      const vfloat r = colour[0] - own[0], g = colour[1] - own[1], b = colour[2] - own[2];
      const vfloat gx = colour[3] - own[3], gy = colour[4] - own[4];
      const vfloat k_colour = max(1.0f - sqrt(r * r + g * g + b * b) * inverse_h, (vfloat)(0.0f));
      const vfloat k_gradient = max(1.0f - sqrt(gx * gx + gy * gy) * inverse_g, (vfloat)(0.0f));
      // The gate keeps an occluder of another colour from scoring by its gradient.
      density += inside * ((1.0f - gradient_share) * k_colour +
                           gradient_share * k_gradient * min(4.0f * k_colour, (vfloat)(1.0f)));
    }
#else
    const float inverse_h2 = 1.0f / (bandwidth * bandwidth);
    vfloat mean[3] = {own[0], own[1], own[2]};
#if STAGE
    for (int k = 0; k < p.num_views; ++k) {
      sample_or_far(band, p, views, strip.ref, k, u, v, h, colour, &count);
      for (int c = 0; c < 3; ++c) staged[SLICE(3 * k + c)] = colour[c];
    }
#else
    for (int k = 0; k < p.num_views; ++k)
      sample_or_far(band, p, views, strip.ref, k, u, v, h, colour, &count);
#endif
    for (int iteration = 0; iteration < ITERATIONS; ++iteration) {
      // Two sets of sums: one would leave the units waiting for the addition before.
      MeanShiftSums even = {0.0f, 0.0f, 0.0f, 0.0f}, odd = {0.0f, 0.0f, 0.0f, 0.0f};
      int k = 0;
#if STAGE
      for (; k + 1 < p.num_views; k += 2) {
        add_sample(&even, staged[SLICE(3 * k)], staged[SLICE(3 * k + 1)], staged[SLICE(3 * k + 2)],
                   mean, inverse_h2);
        add_sample(&odd, staged[SLICE(3 * k + 3)], staged[SLICE(3 * k + 4)],
                   staged[SLICE(3 * k + 5)], mean, inverse_h2);
      }
      if (k < p.num_views)
        add_sample(&even, staged[SLICE(3 * k)], staged[SLICE(3 * k + 1)], staged[SLICE(3 * k + 2)],
                   mean, inverse_h2);
#else
      vfloat ignored = (vfloat)(0.0f);
      for (; k < p.num_views; ++k) {
        sample_or_far(band, p, views, strip.ref, k, u, v, h, colour, &ignored);
        add_sample(&even, colour[0], colour[1], colour[2], mean, inverse_h2);
      }
#endif
      const vfloat weights = even.weights + odd.weights;
      const vfloat scale = 1.0f / max(weights, (vfloat)(1e-12f));
      const vfloat sum[3] = {even.red + odd.red, even.green + odd.green, even.blue + odd.blue};
      vfloat moved = (vfloat)(0.0f);
      for (int c = 0; c < 3; ++c) {
        // Where no sample is near, the mean stays.
        const vfloat next = VSELECT(mean[c], sum[c] * scale, weights > 0.0f);
        moved += (next - mean[c]) * (next - mean[c]);
        mean[c] = next;
      }
      if (!VANY(moved > MOVE_BOUND * MOVE_BOUND * bandwidth * bandwidth)) break;
    }
    for (int k = 0; k < p.num_views; ++k) {
#if STAGE
      density += epanechnikov(staged[SLICE(3 * k)], staged[SLICE(3 * k + 1)],
                              staged[SLICE(3 * k + 2)], mean, inverse_h2);
#else
      vfloat ignored = (vfloat)(0.0f);
      sample_or_far(band, p, views, strip.ref, k, u, v, h, colour, &ignored);
      density += epanechnikov(colour[0], colour[1], colour[2], mean, inverse_h2);
#endif
    }
#endif
    vfloat score = density / max(count, (vfloat)(floor_views));
    score = VSELECT((vfloat)(-1.0f), score, count >= (float)min_views);
    VSTORE(score, scores + score_index(strip, hypotheses.count, row, i, u));
  }
}
