// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Lanes, loads and interpolation that all kernels share. A work-item handles LANES neighbouring
// pixels of a row as explicit vector lanes: 16 on a CPU with 512-bit registers, 1 on a GPU.

#ifndef LANES
#define LANES 16  // neighbouring pixels per work-item: 1, 4, 8 or 16
#endif
#ifndef CHANNELS
#define CHANNELS 3  // planes per view: RGB, or RGB and the gradients gx, gy
#endif
#ifndef CUBIC
#define CUBIC 0  // 1: Catmull-Rom interpolation, 0: linear
#endif
#ifndef SHIFT_ALIKE
#define SHIFT_ALIKE 1  // 1: rays of neighbouring pixels go by one shift (3D, 4D); 0: each its own way
#endif

#ifndef GROUP
#define GROUP 1  // work-items per work-group along u; each has its own slice of local memory
#endif
#if GROUP == 1
#define SLICE(i) (i)
#else
#define SLICE(i) ((i) * GROUP + (int)get_local_id(0))
#endif

// Before a loop over channels: kept as a loop, it keeps the channels in memory.
#define UNROLL _Pragma("unroll")

#if LANES == 1
typedef float vfloat;
typedef int vint;
typedef uint vuint;
#define VLOAD(p) (*(p))
#define VSTORE(value, p) (*(p) = (value))
#define VLANES 0
#define LANE_NUMBERS 0.0f
#define VANY(condition) (condition)
#define VSELECT(otherwise, value, condition) ((condition) ? (value) : (otherwise))
#define VTRUE(condition) (-(condition))
#define VAS_INT(x) as_int(x)
#define VAS_UINT(x) as_uint(x)
#define VAS_FLOAT(x) as_float(x)
#else
#define CONCAT_(a, b) a##b
#define CONCAT(a, b) CONCAT_(a, b)
typedef CONCAT(float, LANES) vfloat;
typedef CONCAT(int, LANES) vint;
typedef CONCAT(uint, LANES) vuint;
#define VLOAD(p) CONCAT(vload, LANES)(0, p)
#define VSTORE(value, p) CONCAT(vstore, LANES)(value, 0, p)
#if LANES == 16
#define VLANES ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#elif LANES == 8
#define VLANES ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
#else
#define VLANES ((int4)(0, 1, 2, 3))
#endif
#define VANY(condition) any(condition)
#define VSELECT(otherwise, value, condition) select((otherwise), (value), (condition))
#define VTRUE(condition) (condition)
#define VAS_INT(x) CONCAT(as_int, LANES)(x)
#define VAS_UINT(x) CONCAT(as_uint, LANES)(x)
#define VAS_FLOAT(x) CONCAT(as_float, LANES)(x)
#endif
#if LANES > 1
#define LANE_NUMBERS CONCAT(convert_float, LANES)(VLANES)
#endif
// VTRUE: a condition as 0 or -1 per lane, whatever LANES is.

// Pixel u of a row of the strip, in a map that holds the strip alone
static inline size_t map_index(const StripParams strip, int row, int u) {
  return (size_t)row * strip.pitch + GIGARAY_PAD + u;
}
// and in a map of the whole view.
static inline size_t view_index(const StripParams strip, int row, int u) {
  return map_index(strip, strip.row_begin + row, u);
}

static inline ulong packed_estimate(float h, float confidence) {
  const uint bits = as_uint(h);
  const uint key = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
  return (ulong)key << 32 | as_uint(fmax(confidence, 0.0f));
}

// Hypotheses as the host counts them, where the device can: rounding must not decide which are tested.
#ifndef FP64
#define FP64 0
#endif
#if FP64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real_t;
#else
typedef float real_t;
#endif
typedef struct {
  real_t min, step;
  int count;
} HypothesisReals;

// a / b to the last bit, as the host has it: a GPU's own division may be off by two. Where there are
// doubles, rounding twice changes nothing.
static inline float quotient(float a, float b) { return (float)((real_t)a / (real_t)b); }

static inline real_t hypothesis_place(const HypothesisReals hypotheses, float h) {
  return clamp(((real_t)h - hypotheses.min) / hypotheses.step, (real_t)0,
               (real_t)(hypotheses.count - 1));
}

// The hypotheses from below `low` to above `high`, and `margin` more on both sides.
static inline ushort2 hypotheses_between(const HypothesisReals hypotheses, float low, float high,
                                         int margin) {
  const int first = (int)floor(hypothesis_place(hypotheses, low)) - margin;
  const int last = (int)ceil(hypothesis_place(hypotheses, high)) + margin;
  return (ushort2)(max(first, 0), min(last, hypotheses.count - 1));
}

static inline float hypothesis_value(const HypothesisReals hypotheses, int i) {
#pragma OPENCL FP_CONTRACT OFF
  const real_t rise = i * hypotheses.step;
  return (float)(hypotheses.min + rise);
}

// Hypothesis 0 of pixel u of a row of a score volume. GIGARAY_PAD floats before and after the volume
// belong to it, so that lanes may reach beyond a pixel's hypotheses.
static inline size_t score_index(const StripParams strip, const HypothesisParams hypotheses, int row,
                                 int u) {
  return GIGARAY_PAD + ((size_t)row * strip.width + u) * hypotheses.pitch;
}

// First and last hypothesis that each of LANES neighbouring pixels wants tested; last is -1 where there
// is nothing to do.
typedef struct {
  int first[LANES], last[LANES];
} LaneBounds;

// Writes the scores of LANES neighbouring pixels under one hypothesis; column: score_index of the first.
static inline void store_scores(__global float* column, const HypothesisParams hypotheses,
                                const LaneBounds* tested, int i, vfloat value) {
  float lanes[LANES];
  VSTORE(value, lanes);
  for (int lane = 0; lane < LANES; ++lane)
    if (i >= tested->first[lane] && i <= tested->last[lane])
      column[(size_t)lane * hypotheses.pitch + i] = lanes[lane];
}

// Hypotheses that a pixel does not want tested get the score of the first or the last one that is: its
// neighbours may ask for them.
static inline void repeat_ends(__global float* column, const HypothesisParams hypotheses, int first,
                               int last) {
  for (int i = 0; i < first; ++i) column[i] = column[first];
  for (int i = last + 1; i < hypotheses.count; ++i) column[i] = column[last];
}

static inline void repeat_ends_of_lanes(__global float* column, const HypothesisParams hypotheses,
                                        const LaneBounds* tested) {
  for (int lane = 0; lane < LANES; ++lane)
    if (tested->last[lane] >= 0)
      repeat_ends(column + (size_t)lane * hypotheses.pitch, hypotheses, tested->first[lane],
                  tested->last[lane]);
}

// Sum of kernels over the views that see the point, but at least over floor_views of them; -1 where
// fewer than min_views do.
static inline vfloat score_of(vfloat density, vfloat count, int min_views, float floor_views) {
  return VSELECT((vfloat)(-1.0f), density / max(count, (vfloat)(floor_views)),
                 count >= (float)min_views);
}

// The first index of whole lanes at or below i.
static inline int lanes_floor(int i) { return i / LANES * LANES; }

// Where a band has a row.
static inline int slot_of(const BandParams p, int v) {
  const int slot = p.first_slot + v - p.row_begin;
  return slot < p.slots ? slot : slot - p.slots;
}

// First pixel of channel 0 of a row of a view, in floats from the band's first.
static inline size_t band_offset(const BandParams p, int view, int v) {
  return ((size_t)slot_of(p, v) * p.num_views + view) * CHANNELS * p.stride + GIGARAY_PAD;
}

static inline __global const float* band_row(__global const float* band, const BandParams p, int view,
                                      int v) {
  return band + band_offset(p, view, v);
}

// Positions this near to a pixel centre are that centre, px. Otherwise rounding would decide whether
// the last column is inside the picture, and a whole shift could cost a second row.
#define SNAP 1e-4f

// The whole number of pixels in x; the rest, in [0, 1), to fraction. Without floor(), which is a call
// with branches on some CPUs.
static inline int split_snapped(float x, float* fraction) {
  int whole = (int)x;
  whole -= x < (float)whole;
  const float rest = x - (float)whole;
  const int up = rest > 1.0f - SNAP;
  *fraction = up || rest < SNAP ? 0.0f : rest;
  return whole + up;
}

// By halves: any() goes through the lanes one by one under PoCL.
static inline float largest_lane(vfloat x) {
#if LANES == 1
  return x;
#else
#if LANES == 16
  const float8 x8 = max(x.lo, x.hi);
#endif
#if LANES == 8
  const float8 x8 = x;
#endif
#if LANES >= 8
  const float4 x4 = max(x8.lo, x8.hi);
#else
  const float4 x4 = x;
#endif
  const float2 x2 = max(x4.lo, x4.hi);
  return max(x2.x, x2.y);
#endif
}

static inline float sum_of_lanes(vfloat x) {
#if LANES == 1
  return x;
#else
#if LANES == 16
  const float8 x8 = x.lo + x.hi;
#endif
#if LANES == 8
  const float8 x8 = x;
#endif
#if LANES >= 8
  const float4 x4 = x8.lo + x8.hi;
#else
  const float4 x4 = x;
#endif
  const float2 x2 = x4.lo + x4.hi;
  return x2.x + x2.y;
#endif
}

// Squared colour distance of LANES neighbouring pixels of two rows.
static inline vfloat colour_distance2(__global const float* a, __global const float* b,
                                      int stride) {
  vfloat sum = (vfloat)(0.0f);
  UNROLL
  for (int c = 0; c < 3; ++c) {
    const vfloat d = VLOAD(a + c * stride) - VLOAD(b + c * stride);
    sum += d * d;
  }
  return sum;
}

// First and last hypothesis that any pixel of a block wants tested; last is -1 when none is to do.
// todo, bounds: maps of the whole view.
static inline int2 block_bounds(__global const uchar* todo, __global const ushort2* bounds,
                                const StripParams strip, int row, int u, LaneBounds* tested) {
  int2 block = (int2)(INT_MAX, -1);
  for (int lane = 0; lane < LANES; ++lane) {
    const size_t i = view_index(strip, row, u + lane);
    const int to_do = u + lane < strip.width && todo[i];
    tested->first[lane] = to_do ? (int)bounds[i].x : INT_MAX;
    tested->last[lane] = to_do ? (int)bounds[i].y : -1;
    block.x = min(block.x, tested->first[lane]);
    block.y = max(block.y, tested->last[lane]);
  }
  return block;
}

// A sample with a red farther than this from the middle of all colours is that of no picture: a
// masked pixel (kMaskedColour) has part in it, which the taps of cubic interpolation may also take
// away.
#define MASKED_BEYOND 1.5f

// Catmull-Rom weights of the taps at -1, 0, 1, 2 for a fraction f in [0, 1).
static inline float4 cubic_weights(float f) {
  const float f2 = f * f, f3 = f2 * f;
  return (float4)(-0.5f * f3 + f2 - 0.5f * f, 1.5f * f3 - 2.5f * f2 + 1.0f,
                  -1.5f * f3 + 2.0f * f2 + 0.5f * f, 0.5f * f3 - 0.5f * f2);
}

// The same, or linear ones.
static inline float4 tap_weights(float f) {
#if CUBIC
  return cubic_weights(f);
#else
  return (float4)(0.0f, 1.0f - f, f, 0.0f);
#endif
}

static inline vfloat interpolate_row(__global const float* x, float f, float4 w) {
#if CUBIC
  return w.s0 * VLOAD(x - 1) + w.s1 * VLOAD(x) + w.s2 * VLOAD(x + 1) + w.s3 * VLOAD(x + 2);
#else
  const vfloat left = VLOAD(x);
  return left + f * (VLOAD(x + 1) - left);
#endif
}

// The colour that a view shows at one place; vectors hold the four taps of a row. Returns 0 where it
// shows nothing of the scene.
static inline int sample_pixel(__global const float* band, const BandParams p, int view, float x,
                               float y, float* colour) {
  float fx, fy;
  const int xi = split_snapped(x, &fx), yi = split_snapped(y, &fy);
  if (xi < 0 || xi + (fx > 0.0f) > p.width - 1 || yi < 0 || yi + (fy > 0.0f) > p.height - 1) return 0;
  const float4 wx = tap_weights(fx), wy = tap_weights(fy);
  __global const float* at = band_row(band, p, view, yi) + xi - 1;
  __global const float* above = band_row(band, p, view, max(yi - 1, 0)) + xi - 1;
  __global const float* below = band_row(band, p, view, min(yi + 1, p.height - 1)) + xi - 1;
  __global const float* below2 = band_row(band, p, view, min(yi + 2, p.height - 1)) + xi - 1;
  UNROLL
  for (int c = 0; c < 3; ++c) {
    const int o = c * p.stride;
    float4 column = vload4(0, at + o);
    if (fy > 0.0f)
      column = wy.s0 * vload4(0, above + o) + wy.s1 * column + wy.s2 * vload4(0, below + o) +
               wy.s3 * vload4(0, below2 + o);
    colour[c] = dot(wx, column);
  }
  return fabs(colour[0] - 0.5f) <= MASKED_BEYOND;
}

// Where a view sees a block of LANES pixels: row, column of the first one, fractions in [0, 1).
typedef struct {
  int x, y;
  float fx, fy;
} BlockPosition;

// Returns 0 when no lane is inside the picture. inside: 1 for lanes that are, else 0.
static inline int place_block(const BandParams p, const BlockShift shift, int u, int v,
                              BlockPosition* at, vfloat* inside) {
  at->x = u + shift.whole_u;
  at->y = v + shift.whole_v;
  at->fx = shift.fraction_u;
  at->fy = shift.fraction_v;
  const int last_column = p.width - 1 - (at->fx > 0.0f);
  if (at->y < 0 || at->y + (at->fy > 0.0f) > p.height - 1) return 0;
  if (at->x >= 0 && at->x + LANES - 1 <= last_column) {
    *inside = (vfloat)(1.0f);
    return 1;
  }
  if (at->x + LANES <= 0 || at->x > last_column) return 0;
  const vint x = at->x + VLANES;
  *inside = VSELECT((vfloat)(0.0f), (vfloat)(1.0f), x >= 0 && x <= last_column);
  return 1;
}

// Channels [first, end) of a view there; anything in lanes outside the picture.
static inline __attribute__((always_inline)) void sample_block(__global const float* band, const BandParams p, int view,
                                const BlockPosition at, int first, int end, vfloat* colour) {
  const float4 wx = CUBIC ? cubic_weights(at.fx) : (float4)(0.0f);
  __global const float* row = band_row(band, p, view, at.y) + at.x;
  UNROLL
  for (int c = first; c < end; ++c) colour[c] = interpolate_row(row + c * p.stride, at.fx, wx);
  if (at.fy > 0.0f) {
    __global const float* below = band_row(band, p, view, at.y + 1) + at.x;
#if CUBIC
    const float4 wy = cubic_weights(at.fy);
    __global const float* above = at.y > 0 ? band_row(band, p, view, at.y - 1) + at.x : row;
    __global const float* below2 =
        at.y + 2 < p.height ? band_row(band, p, view, at.y + 2) + at.x : below;
    UNROLL
    for (int c = first; c < end; ++c)
      colour[c] = wy.s0 * interpolate_row(above + c * p.stride, at.fx, wx) + wy.s1 * colour[c] +
                  wy.s2 * interpolate_row(below + c * p.stride, at.fx, wx) +
                  wy.s3 * interpolate_row(below2 + c * p.stride, at.fx, wx);
#else
    UNROLL
    for (int c = first; c < end; ++c)
      colour[c] += at.fy * (interpolate_row(below + c * p.stride, at.fx, wx) - colour[c]);
#endif
  }
}

// ---- Rays that go each its own way (SHIFT_ALIKE 0) -----------------------------------------------
// Their samples come from taps, in which the channels of a pixel lie together:
//   taps  [slot][view][width + 1][TAP_WIDTH]: RGB and nothing, then gx, gy and two times nothing
// The last pixel of a row is there twice, for the tap to the right.

#define TAP_WIDTH (CHANNELS > 3 ? 8 : 4)

// Where another view sees LANES pixels, px, and how that place changes with the pixel.
typedef struct {
  vfloat x, y;
  vfloat x_u, x_v, y_u, y_v;
} LanePlaces;

#if CHANNELS > 3
typedef float8 tap_t;
#define VLOAD_TAP(p) vload8(0, p)
#else
typedef float4 tap_t;
#define VLOAD_TAP(p) vload4(0, p)
#endif

#if LANES == 1
#define VFLOOR_INT(x) ((int)(x))
#define VTO_FLOAT(x) ((float)(x))
#else
#define VFLOOR_INT(x) CONCAT(convert_int, LANES)(x)  // of x >= 0
#define VTO_FLOAT(x) CONCAT(convert_float, LANES)(x)
#endif

// Four channels of LANES pixels, from pixels to planes.
static inline void planes_of(const float4* pixels, vfloat* planes) {
#if LANES == 1
  planes[0] = pixels[0].s0;
  planes[1] = pixels[0].s1;
  planes[2] = pixels[0].s2;
  planes[3] = pixels[0].s3;
#else
#if LANES == 16
  const vfloat a = (float16)(pixels[0], pixels[1], pixels[2], pixels[3]);
  const vfloat b = (float16)(pixels[4], pixels[5], pixels[6], pixels[7]);
  const vfloat c = (float16)(pixels[8], pixels[9], pixels[10], pixels[11]);
  const vfloat d = (float16)(pixels[12], pixels[13], pixels[14], pixels[15]);
#elif LANES == 8
  const vfloat a = (float8)(pixels[0], pixels[1]), b = (float8)(pixels[2], pixels[3]);
  const vfloat c = (float8)(pixels[4], pixels[5]), d = (float8)(pixels[6], pixels[7]);
#else
  const vfloat a = pixels[0], b = pixels[1], c = pixels[2], d = pixels[3];
#endif
  const vfloat even_ab = (vfloat)(a.even, b.even), even_cd = (vfloat)(c.even, d.even);
  const vfloat odd_ab = (vfloat)(a.odd, b.odd), odd_cd = (vfloat)(c.odd, d.odd);
  planes[0] = (vfloat)(even_ab.even, even_cd.even);
  planes[1] = (vfloat)(odd_ab.even, odd_cd.even);
  planes[2] = (vfloat)(even_ab.odd, even_cd.odd);
  planes[3] = (vfloat)(odd_ab.odd, odd_cd.odd);
#endif
}

// Bilinear samples of a view at LANES places: RGB, then gx and gy along the axes of the view. inside: 1
// for lanes inside the picture and clear of masked pixels, else 0; those hold anything. Returns 0 when
// no lane is inside the picture.
static inline __attribute__((always_inline)) int sample_lanes(__global const float* taps,
                                                              const BandParams p, int view,
                                                              vfloat x, vfloat y, vfloat* sample,
                                                              vfloat* inside) {
  const float right = (float)(p.width - 1), bottom = (float)(p.height - 1);
  const vfloat in_picture =
      VSELECT((vfloat)(0.0f), (vfloat)(1.0f),
              x >= -SNAP && x <= right + SNAP && y >= -SNAP && y <= bottom + SNAP);
  if (!(largest_lane(in_picture) > 0.0f)) return 0;
  x = clamp(x, 0.0f, right);
  y = clamp(y, (float)p.row_begin, (float)(p.row_end - 1));
  const vint xi = VFLOOR_INT(x), yi = VFLOOR_INT(y);
  const vfloat fx = x - VTO_FLOAT(xi), fy = y - VTO_FLOAT(yi);
  // In floats: a buffer has less than 2^31 of them.
  const int pitch = (p.width + 1) * TAP_WIDTH, next = p.num_views * pitch;
  vint slot = yi + (p.first_slot - p.row_begin);
  slot -= VSELECT((vint)(0), (vint)(p.slots), slot >= p.slots);
  const vint first = slot * next + view * pitch + xi * TAP_WIDTH;
  const vint to_next = VSELECT((vint)(next), (vint)((1 - p.slots) * next), slot + 1 == p.slots);
  const vint second = first + VSELECT((vint)(0), to_next, yi + 1 < p.row_end);
  int upper[LANES], lower[LANES];
  float along[LANES], across[LANES];
  VSTORE(first, upper);
  VSTORE(second, lower);
  VSTORE(fx, along);
  VSTORE(fy, across);
  float4 colours[LANES];
#if CHANNELS > 3
  float4 gradients[LANES];
#endif
  UNROLL
  for (int lane = 0; lane < LANES; ++lane) {
    __global const float* a = taps + upper[lane];
    __global const float* b = taps + lower[lane];
    const tap_t above = VLOAD_TAP(a), below = VLOAD_TAP(b);
    const tap_t top = above + along[lane] * (VLOAD_TAP(a + TAP_WIDTH) - above);
    const tap_t low = below + along[lane] * (VLOAD_TAP(b + TAP_WIDTH) - below);
    const tap_t value = top + across[lane] * (low - top);
#if CHANNELS > 3
    colours[lane] = value.lo;
    gradients[lane] = value.hi;
#else
    colours[lane] = value;
#endif
  }
  vfloat planes[4];
  planes_of(colours, planes);
  UNROLL
  for (int c = 0; c < 3; ++c) sample[c] = planes[c];
#if CHANNELS > 3
  planes_of(gradients, planes);
  sample[3] = planes[0];
  sample[4] = planes[1];
#endif
  *inside = VSELECT((vfloat)(0.0f), in_picture, fabs(sample[0] - 0.5f) <= MASKED_BEYOND);
  return 1;
}

#if LANES == 1
#define PIXELS_FROM(u) ((float)(u))
#else
#define PIXELS_FROM(u) ((vfloat)(u) + LANE_NUMBERS)  // places of LANES neighbours
#endif
