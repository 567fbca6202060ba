// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Plain structs shared by host and device, passed to kernels by value.
#ifndef GIGARAY_KERNEL_PARAMS_H
#define GIGARAY_KERNEL_PARAMS_H

#ifndef __OPENCL_C_VERSION__
namespace gigaray {
#endif

/// Columns of padding left and right of every row of a band: the edge pixel repeated, so that a
/// load of LANES neighbours with interpolation taps never leaves the row.
#define GIGARAY_PAD 32

/// The scan-line step follows columns in blocks of rows, each with rows around it: see scanline.cl.
#define SCANLINE_BLOCK 16
#define SCANLINE_REACH 16

/// A band: rows [row_begin, row_end) of all views at one level, as floats
/// [slot][view][channel][stride], pixel u at GIGARAY_PAD + u. Row row_begin is in first_slot, and
/// after the last slot comes the first.
typedef struct BandParams {
  int width;   ///< of the level, px
  int height;  ///< of the level, px
  int num_views;
  int stride;  ///< floats per row of one channel, padding included
  int row_begin;
  int row_end;
  int slots;
  int first_slot;
} BandParams;

/// The rows of the reference view that a step works on. Maps of it are [row - row_begin][pitch]
/// with pixel u at GIGARAY_PAD + u, as in a band, and pitch is the stride of the band. Score
/// volumes are [row][u][hypothesis], see score_index().
typedef struct StripParams {
  int ref;    ///< reference view
  int width;  ///< px
  int row_begin;
  int row_end;
  int pitch;
} StripParams;

/// Hypothesis i is min + i * step.
typedef struct HypothesisParams {
  float min;
  float step;
  int count;
  int pitch;  ///< floats per pixel of a score volume: count, rounded up to whole lanes
} HypothesisParams;

/// Where another view sees a block of neighbouring pixels (u, v), (u + 1, v), … of the reference
/// view under one hypothesis: from (u + whole_u + fraction_u, v + whole_v + fraction_v) on.
/// Fractions are in [0, 1).
typedef struct BlockShift {
  int whole_u;
  int whole_v;
  float fraction_u;
  float fraction_v;
} BlockShift;

#ifndef __OPENCL_C_VERSION__
}  // namespace gigaray
#endif

#endif
