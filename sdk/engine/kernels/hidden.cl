// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What few views can't confirm. Where a view sees two estimates of the reference view at one place, only
// one of them can be right: the more confident one. An estimate that loses in all views, or that none
// of them can see, is a guess; so is a speck, an estimate that few around it share. What is behind
// continues there, as far as the row knows it.
//   disparity, confidence  [v][pitch]: estimates of the view
//   hidden     [v][pitch] 1: loses everywhere
//   guessed    [v][pitch] 1: hidden or a speck
//   apart      hypothesis units: a difference that moves a point by a pixel in some view
// One work-item per pixel.

// The pixel of the reference view whose point under h a view sees at (x, y), to first order.
static inline int pixel_seen_at(__global const float* rays, int view, int u, int v, float h, float x,
                                float y, float* own_u, float* own_v) {
  float here_x, here_y, right_x, right_y, down_x, down_y, there;
  if (!locate(rays, view, u, v, h, &here_x, &here_y, &there) ||
      !locate(rays, view, u + 1, v, h, &right_x, &right_y, &there) ||
      !locate(rays, view, u, v + 1, h, &down_x, &down_y, &there))
    return 0;
  const float a = right_x - here_x, b = down_x - here_x, c = right_y - here_y, d = down_y - here_y;
  const float area = a * d - b * c;
  if (!(fabs(area) > SIDE_LEAST_AREA)) return 0;
  *own_u = u + (d * (x - here_x) - b * (y - here_y)) / area;
  *own_v = v + (a * (y - here_y) - c * (x - here_x)) / area;
  return 1;
}

// least, count: hypotheses `apart` from each other, over the range.
__kernel void find_hidden(const BandParams p, const StripParams strip, __global const float* rays,
                          __global const uchar* todo, __global const float* disparity,
                          __global const float* confidence, const float least, const int count,
                          const float apart, __global uchar* hidden) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  hidden[pixel] = 0;
  const float h = disparity[pixel], own = confidence[pixel];
  if (!todo[pixel] || isnan(h)) return;
  for (int k = 0; k < p.num_views; ++k) {
    float x, y, there;
    if (k == strip.ref || !locate(rays, k, u, v, h, &x, &y, &there)) continue;
    if (!(x >= 0.0f && x <= (float)(p.width - 1) && y >= 0.0f && y <= (float)(p.height - 1)))
      continue;
    int loses = 0;
    for (int i = 0; i < count && !loses; ++i) {
      const float tested = least + i * apart;
      float other_u, other_v;
      if (!(fabs(tested - h) > (1.0f - HIDDEN_NEAR) * apart) ||
          !pixel_seen_at(rays, k, u, v, tested, x, y, &other_u, &other_v))
        continue;
      if (!(other_u > -0.5f && other_u < p.width - 0.5f && other_v > -0.5f &&
            other_v < p.height - 0.5f && fabs(other_v - v) < HIDDEN_REACH))
        continue;
      const size_t at =
          (size_t)(int)rint(other_v) * strip.pitch + GIGARAY_PAD + (int)rint(other_u);
      loses = fabs(disparity[at] - tested) <= HIDDEN_NEAR * apart &&
              fabs(disparity[at] - h) > apart && confidence[at] > own;
    }
    if (!loses) return;
  }
  hidden[pixel] = 1;
}

__kernel void find_specks(const StripParams strip, const int height, __global const uchar* todo,
                          __global const float* disparity, __global const uchar* hidden,
                          const float apart, __global uchar* guessed) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  guessed[pixel] = hidden[pixel];
  if (!todo[pixel] || hidden[pixel]) return;
  const float h = disparity[pixel];
  int all = 0, alike = 0;
  for (int y = max(v - SPECK_RADIUS, 0); y <= min(v + SPECK_RADIUS, height - 1); ++y)
    for (int x = max(u - SPECK_RADIUS, 0); x <= min(u + SPECK_RADIUS, strip.width - 1); ++x) {
      const size_t at = (size_t)y * strip.pitch + GIGARAY_PAD + x;
      ++all;
      alike += !hidden[at] && fabs(disparity[at] - h) <= apart;
    }
  guessed[pixel] = alike < SPECK_SHARE * all;
}

// In place: what is guessed is written, what is not is read.
__kernel void fill_hidden(const StripParams strip, __global const uchar* guessed,
                          const float apart, __global float* disparity,
                          __global float* confidence) {
  const int u = get_global_id(0), row = get_global_id(1);
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u), begin = pixel - u;
  if (!guessed[pixel]) return;
  int left = u - 1, right = u + 1;
  while (left >= 0 && (guessed[begin + left] || !(confidence[begin + left] > 0.0f))) --left;
  while (right < strip.width && (guessed[begin + right] || !(confidence[begin + right] > 0.0f)))
    ++right;
  if (left < 0 && right >= strip.width) return;
  // The farther of both ends: the nearer surface is the one that hides.
  const int from = left < 0                ? right
                   : right >= strip.width ? left
                   : disparity[begin + right] < disparity[begin + left] ? right
                                                                        : left;
  const float behind = disparity[begin + from];
  // A guess that is no worse stays.
  if (!(fabs(disparity[pixel] - behind) <= apart)) disparity[pixel] = behind;
  confidence[pixel] = FILLED_CONFIDENCE * confidence[begin + from];
}
