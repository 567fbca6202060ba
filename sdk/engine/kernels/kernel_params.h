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

/// The kernel of colour in robust_score.cl: a triangle, and one that is TAIL_WIDTH as wide, whose
/// part is TAIL_SHARE: colours that change a little with the view still count.
#define TAIL_SHARE 0.3f
#define TAIL_WIDTH 3.0f

/// Sides of jumps, see jump_sides.cl. What is within the squared distance SIDE_WINDOW2 of a pixel,
/// SIDE_WINDOW rows, tells whether there is a jump; what is within SIDE_COLOURS which colours the
/// sides have, where each shows SIDE_LEAST_COLOURS. The kernel is SIDE_WIDER than that of scores;
/// sums are divided by a share of the other views at least. A colour counts SIDE_COLOUR_SHARE, and
/// a pixel goes over to the other side when that leads by SIDE_LEAD.
#define SIDE_WINDOW 2
#define SIDE_WINDOW2 5
#define SIDE_COLOURS 3
#define SIDE_LEAST_COLOURS 3.0f
#define SIDE_VIEW_REACH 16  // rows; what stands in the way is looked for no farther away
#define SIDE_WIDER 4.0f
#define SIDE_NEAR_FLOOR 0.25f
#define SIDE_FAR_FLOOR (1.0f / 6.0f)
#define SIDE_COLOUR_SHARE 0.5f
#define SIDE_LEAD 0.1f
#define SIDE_LEAST_AREA 1e-6f  // of a pixel in another view, px²

/// What few views can't confirm, see hidden.cl. Estimates are at one place in a view when they are
/// no farther from it than HIDDEN_NEAR px; they are looked for less than HIDDEN_REACH rows away. A
/// speck is what less than SPECK_SHARE of the estimates within SPECK_RADIUS share. What is filled
/// is FILLED_CONFIDENCE as sure as what it continues.
#define HIDDEN_REACH 16
#define HIDDEN_NEAR 0.75f
#define SPECK_RADIUS 5
#define SPECK_SHARE 0.3f
#define FILLED_CONFIDENCE 0.25f

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
