// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Turns decoded rows into the planes of a band: colours through a look-up table, gradients of the
// channel mean, padding.
//   first_row  of those that are unpacked: the work-items begin there
//   encoded  [v - encoded_begin][stored view][u][3], integers of `bits` 8 or 16 (level 0), through lut;
//            bits 32: [v - encoded_begin][stored view][3][u] floats in the working colour space (level
//            1 on)
//   at       [view] which of the stored views it is
//   band     [slot][view][CHANNELS][stride]
// Work-group shape: none; one work-item per (view, row).

__kernel void unpack_colours(__global const uchar* encoded, const int bits,
                             const int encoded_begin, const int stored_views,
                             __global const int* at, __global const float* lut, const BandParams p,
                             const int first_row, __global float* band) {
  const int view = get_global_id(0), v = first_row + get_global_id(1);
  const size_t line = (size_t)(v - encoded_begin) * stored_views + at[view];
  __global const uchar* in = encoded + line * 3 * p.width * (bits / 8);
  __global float* out = band + band_offset(p, view, v);
  for (int c = 0; c < 3; ++c) {
    __global float* plane = out + c * p.stride;
    if (bits == 8)
      for (int u = 0; u < p.width; ++u) plane[u] = lut[in[3 * u + c]];
    else if (bits == 16)
      for (int u = 0; u < p.width; ++u) plane[u] = lut[((__global const ushort*)in)[3 * u + c]];
    else
      for (int u = 0; u < p.width; ++u)
        plane[u] = ((__global const float*)in)[c * p.width + u];
    for (int i = 1; i <= GIGARAY_PAD; ++i) plane[-i] = plane[0];
    for (int u = p.width; u < p.stride - GIGARAY_PAD; ++u) plane[u] = plane[p.width - 1];
  }
}

// shown: [(v << shift) - shown_begin][stored view][shown_width], 0: the pixel shows nothing of the
// scene.
__kernel void mask_pixels(__global const uchar* shown, const int shown_begin, const int shown_width,
                          const int shift, const int stored_views, __global const int* at,
                          const float masked_colour, const BandParams p, const int first_row,
                          __global float* band) {
  const int view = get_global_id(0), v = first_row + get_global_id(1);
  const size_t line = (size_t)((v << shift) - shown_begin) * stored_views + at[view];
  __global const uchar* in = shown + line * shown_width;
  __global float* out = band + band_offset(p, view, v);
  for (int u = 0; u < p.width; ++u)
    if (in[(size_t)u << shift] == 0)
      for (int c = 0; c < 3; ++c) out[c * p.stride + u] = masked_colour;
}

// The same band with the channels of a pixel side by side, see common.cl.
__kernel void interleave_taps(__global const float* band, const BandParams p, const int first_row,
                              __global float* taps) {
  const int view = get_global_id(0), v = first_row + get_global_id(1);
  __global const float* in = band_row(band, p, view, v);
  __global float* out =
      taps + ((size_t)slot_of(p, v) * p.num_views + view) * (p.width + 1) * TAP_WIDTH;
  for (int u = 0; u <= p.width; ++u) {  // the padding repeats the last pixel
    for (int c = 0; c < 3; ++c) out[u * TAP_WIDTH + c] = in[c * p.stride + u];
#if CHANNELS > 3
    for (int c = 3; c < 5; ++c) out[u * TAP_WIDTH + c + 1] = in[c * p.stride + u];
#endif
  }
}

// gx, gy: half the difference of the neighbours' channel means; at the border the pixel itself
// takes the missing neighbour's place. Rows at the edge of a band that is not the picture's edge
// get a one-sided gy: the halo of a band includes one row for that.
__kernel void unpack_gradients(const BandParams p, const int first_row, __global float* band) {
#if CHANNELS == 5
  const int view = get_global_id(0), v = first_row + get_global_id(1);
  __global float* here = band + band_offset(p, view, v);
  __global const float* above = v > p.row_begin ? band_row(band, p, view, v - 1) : here;
  __global const float* below = v + 1 < p.row_end ? band_row(band, p, view, v + 1) : here;
  __global float* gx = here + 3 * p.stride;
  __global float* gy = here + 4 * p.stride;
  const int g = p.stride, b = 2 * p.stride;
  for (int u = 0; u < p.width; ++u) {
    const int l = max(u - 1, 0), r = min(u + 1, p.width - 1);
    gx[u] = (here[r] + here[g + r] + here[b + r] - here[l] - here[g + l] - here[b + l]) * (1.0f / 6);
    gy[u] =
        (below[u] + below[g + u] + below[b + u] - above[u] - above[g + u] - above[b + u]) * (1.0f / 6);
  }
  for (int c = 3; c < 5; ++c) {
    __global float* plane = here + c * p.stride;
    for (int i = 1; i <= GIGARAY_PAD; ++i) plane[-i] = plane[0];
    for (int u = p.width; u < p.stride - GIGARAY_PAD; ++u) plane[u] = plane[p.width - 1];
  }
#endif
}
