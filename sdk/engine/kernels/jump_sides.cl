// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The last look at pixels beside a jump: to which of its two sides do they belong? Windows mix what the
// pixels of both say; here every pixel speaks for itself.
//   disparity  [v][pitch]: estimates. There is a jump where those within SIDE_WINDOW differ by more
//              than `jump`; the nearer and the farther half of their range are its sides
//   evidence   [v][pitch]: mean kernel of colour under the estimate of the nearer side, over all other
//              views, minus the same under that of the farther side, over those that see so far: not
//              those where an estimate of the nearer side stands in the way. NaN: no jump, or nothing
//              to do
// The kernel is wider than that of a score. Pixels at the edge of a surface are mixed; views that shift
// the sides against each other show other mixtures, and how far those are off tells which side has the
// larger part.
// One work-item per pixel.

// The nearest estimate of each side; NaN where there is none.
typedef struct {
  float middle;
  float near, far;
  size_t near_at, far_at;  // in maps of the view
} Sides;

static inline Sides sides_at(__global const float* disparity, const StripParams strip, int height,
                             int u, int v, float jump) {
  const int top = max(v - SIDE_WINDOW, 0), bottom = min(v + SIDE_WINDOW, height - 1);
  const int left = max(u - SIDE_WINDOW, 0), right = min(u + SIDE_WINDOW, strip.width - 1);
  Sides sides = {NAN, NAN, NAN, 0, 0};
  float low = INFINITY, high = -INFINITY;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      if ((x - u) * (x - u) + (y - v) * (y - v) > SIDE_WINDOW2) continue;
      const float d = disparity[(size_t)y * strip.pitch + GIGARAY_PAD + x];
      low = fmin(low, d);
      high = fmax(high, d);
    }
  if (!(high - low > jump)) return sides;
  sides.middle = 0.5f * (low + high);
  int near2 = INT_MAX, far2 = INT_MAX;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const int distance2 = (x - u) * (x - u) + (y - v) * (y - v);
      if (distance2 > SIDE_WINDOW2) continue;
      const size_t at = (size_t)y * strip.pitch + GIGARAY_PAD + x;
      const float d = disparity[at];
      if (d >= sides.middle && distance2 < near2) {
        near2 = distance2;
        sides.near = d;
        sides.near_at = at;
      } else if (d < sides.middle && distance2 < far2) {
        far2 = distance2;
        sides.far = d;
        sides.far_at = at;
      }
    }
  return sides;
}

// Kernel of the colour that a view shows at (x, y); below 0: it shows nothing there.
static inline float side_kernel(__global const float* band, const BandParams p, int view, float x,
                                float y, const float* own, float bandwidth) {
  float colour[3], d2 = 0.0f;
  if (!sample_pixel(band, p, view, x, y, colour)) return -1.0f;
  UNROLL
  for (int c = 0; c < 3; ++c) d2 += (colour[c] - own[c]) * (colour[c] - own[c]);
  return max(1.0f - sqrt(d2) / bandwidth, 0.0f);
}

__kernel void side_evidence(__global const float* band, const BandParams p, const StripParams strip,
                            __global const float* own_band, const BandParams own_p,
                            const int own_view, __global const float* rays,
                            __global const uchar* todo, __global const float* disparity,
                            const float jump, const float least, const float most,
                            const float bandwidth, __global float* evidence) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  evidence[pixel] = NAN;
  if (!todo[pixel]) return;
  const Sides sides = sides_at(disparity, strip, p.height, u, v, jump);
  if (isnan(sides.near) || isnan(sides.far)) return;
  // Estimates from other views may lie outside the range; rows are loaded for that.
  const float near = clamp(sides.near, least, most), far = clamp(sides.far, least, most);
  __global const float* here = band_row(own_band, own_p, own_view, v) + u;
  const float own[3] = {here[0], here[p.stride], here[2 * p.stride]};

  float near_sum = 0.0f, near_count = 0.0f, far_sum = 0.0f, far_count = 0.0f;
  for (int k = 0; k < p.num_views; ++k) {
    if (k == strip.ref) continue;
    float near_x, near_y, far_x, far_y, right_x, right_y, down_x, down_y, there;
    if (!locate(rays, k, u, v, near, &near_x, &near_y, &there) ||
        !locate(rays, k, u, v, far, &far_x, &far_y, &there) ||
        !locate(rays, k, u + 1, v, near, &right_x, &right_y, &there) ||
        !locate(rays, k, u, v + 1, near, &down_x, &down_y, &there))
      continue;
    const float a = right_x - near_x, b = down_x - near_x, c = right_y - near_y, d = down_y - near_y;
    const float area = a * d - b * c;
    if (!(fabs(area) > SIDE_LEAST_AREA)) continue;
    const float near_kernel = side_kernel(band, p, k, near_x, near_y, own, bandwidth);
    if (near_kernel >= 0.0f) {
      near_sum += near_kernel;
      near_count += 1.0f;
    }
    const float far_kernel = side_kernel(band, p, k, far_x, far_y, own, bandwidth);
    if (far_kernel < 0.0f) continue;
    // The pixel whose point on the nearer side would stand in the way, from how places in the view
    // change with the pixel; no farther than rows are looked at.
    const float x = far_x - near_x, y = far_y - near_y;
    const float du = (d * x - b * y) / area, dv = (a * y - c * x) / area;
    const float nearer = min(1.0f, SIDE_VIEW_REACH / fabs(dv));
    const float last_u = (float)(strip.width - 1), last_v = (float)(p.height - 1);
    const int before_u = (int)rint(clamp(u + nearer * du, 0.0f, last_u));
    const int before_v = (int)rint(clamp(v + nearer * dv, 0.0f, last_v));
    if (disparity[(size_t)before_v * strip.pitch + GIGARAY_PAD + before_u] >= sides.middle) continue;
    far_sum += far_kernel;
    far_count += 1.0f;
  }
  const float others = (float)(p.num_views - 1);
  evidence[pixel] = near_sum / max(near_count, SIDE_NEAR_FLOOR * others) -
                    far_sum / max(far_count, SIDE_FAR_FLOOR * others);
}

// Colours that one side shows around a pixel.
typedef struct {
  float count, sum[3], squares;
} SideColours;

// The evidence of a pixel and its neighbours of the same colour, and where its colour lies between the
// colours of both sides, as far as those tell the sides apart.
__kernel void choose_sides(__global const float* own_band, const BandParams own_p,
                           const StripParams strip, __global const float* disparity,
                           __global const float* confidence, __global const float* evidence,
                           const float jump, const float sigma_colour, __global float* chosen,
                           __global float* chosen_confidence) {
  const int u = get_global_id(0), row = get_global_id(1), v = strip.row_begin + row;
  if (u >= strip.width) return;
  const size_t pixel = view_index(strip, row, u);
  chosen[pixel] = disparity[pixel];
  chosen_confidence[pixel] = confidence[pixel];
  if (isnan(evidence[pixel]) || isnan(disparity[pixel])) return;
  const Sides sides = sides_at(disparity, strip, own_p.height, u, v, jump);
  __global const float* here = band_row(own_band, own_p, strip.ref, v) + u;
  const float own[3] = {here[0], here[own_p.stride], here[2 * own_p.stride]};

  float sum = 0.0f, weights = 0.0f;
  SideColours colours[2] = {{0.0f, {0.0f, 0.0f, 0.0f}, 0.0f}, {0.0f, {0.0f, 0.0f, 0.0f}, 0.0f}};
  for (int y = max(v - SIDE_COLOURS, 0); y <= min(v + SIDE_COLOURS, own_p.height - 1); ++y)
    for (int x = max(u - SIDE_COLOURS, 0); x <= min(u + SIDE_COLOURS, strip.width - 1); ++x) {
      const int distance2 = (x - u) * (x - u) + (y - v) * (y - v);
      if (distance2 > SIDE_COLOURS * SIDE_COLOURS) continue;
      const size_t at = (size_t)y * strip.pitch + GIGARAY_PAD + x;
      __global const float* there = band_row(own_band, own_p, strip.ref, y) + x;
      const float colour[3] = {there[0], there[own_p.stride], there[2 * own_p.stride]};
      if (distance2 <= 2 && !isnan(evidence[at])) {
        float d2 = 0.0f;
        for (int c = 0; c < 3; ++c) d2 += (colour[c] - own[c]) * (colour[c] - own[c]);
        const float w = exp(-0.5f * (d2 / (sigma_colour * sigma_colour) + distance2));
        sum += w * evidence[at];
        weights += w;
      }
      if (distance2 == 0 || isnan(disparity[at]) || fabs(colour[0] - 0.5f) > MASKED_BEYOND) continue;
      SideColours* side = &colours[disparity[at] >= sides.middle];
      side->count += 1.0f;
      for (int c = 0; c < 3; ++c) {
        side->sum[c] += colour[c];
        side->squares += colour[c] * colour[c];
      }
    }
  float answer = sum / weights;
  if (colours[0].count >= SIDE_LEAST_COLOURS && colours[1].count >= SIDE_LEAST_COLOURS) {
    float apart2 = 0.0f, along = 0.0f, spread2 = 1e-4f;
    for (int c = 0; c < 3; ++c) {
      const float far = colours[0].sum[c] / colours[0].count;
      const float apart = colours[1].sum[c] / colours[1].count - far;
      apart2 += apart * apart;
      along += (own[c] - far) * apart;
    }
    for (int i = 0; i < 2; ++i) {
      float mean2 = 0.0f;
      for (int c = 0; c < 3; ++c)
        mean2 += colours[i].sum[c] * colours[i].sum[c] / (colours[i].count * colours[i].count);
      spread2 += max(colours[i].squares / colours[i].count - mean2, 0.0f);
    }
    const float place = clamp(2.0f * along / max(apart2, 1e-8f) - 1.0f, -1.0f, 1.0f);
    answer += SIDE_COLOUR_SHARE * place * apart2 / (apart2 + spread2);
  }
  const int is_near = disparity[pixel] >= sides.middle;
  if (is_near ? !(answer < -SIDE_LEAD) : !(answer > SIDE_LEAD)) return;
  const size_t from = is_near ? sides.far_at : sides.near_at;
  chosen[pixel] = disparity[from];
  chosen_confidence[pixel] = confidence[from];
}
