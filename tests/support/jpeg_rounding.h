// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "gigaray/core/jpeg_blocks.h"

namespace gigaray::testing_support {

/// Rounds the DCT coefficients of 8×8 blocks, in plain loops. Sides of the plane: multiples of 8.
inline void round_blocks(FloatMap& plane, const JpegTable& steps) {
  const auto basis = [](int k, int n) {
    return std::sqrt((k == 0 ? 1 : 2) / 8.0) * std::cos((2 * n + 1) * k * std::numbers::pi / 16);
  };
  for (int top = 0; top < plane.height(); top += 8)
    for (int left = 0; left < plane.width(); left += 8) {
      double coefficients[8][8];
      for (int k = 0; k < 8; ++k)
        for (int l = 0; l < 8; ++l) {
          double sum = 0;
          for (int v = 0; v < 8; ++v)
            for (int u = 0; u < 8; ++u) sum += basis(k, v) * basis(l, u) * plane(left + u, top + v);
          coefficients[k][l] = steps(k, l) * std::round(sum / steps(k, l));
        }
      for (int v = 0; v < 8; ++v)
        for (int u = 0; u < 8; ++u) {
          double sum = 0;
          for (int k = 0; k < 8; ++k)
            for (int l = 0; l < 8; ++l) sum += basis(k, v) * basis(l, u) * coefficients[k][l];
          plane(left + u, top + v) = float(sum);
        }
    }
}

/// What JPEG makes of a picture of 8 bit, (v, u, c). Where steps.chroma is empty chroma stays as it
/// is; samples of chroma are repeated over the pixels that they cover.
inline Image<std::uint16_t> jpeg_rounded(const Image<std::uint16_t>& picture,
                                         const JpegSteps& steps) {
  const int width = picture.width(), height = picture.height();
  const int columns = steps.chroma_width, rows = steps.chroma_height;
  FloatMap luma(width, height), blue(width / columns, height / rows), red = blue;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const float r = picture(u, v, 0), g = picture(u, v, 1), b = picture(u, v, 2);
      luma(u, v) = 0.299f * r + 0.587f * g + 0.114f * b;
      blue(u / columns, v / rows) += (b - luma(u, v)) / 1.772f / float(columns * rows);
      red(u / columns, v / rows) += (r - luma(u, v)) / 1.402f / float(columns * rows);
    }
  for (float& value : luma) value -= 128;
  round_blocks(luma, steps.luma);
  if (steps.chroma)
    for (FloatMap* plane : {&blue, &red}) round_blocks(*plane, *steps.chroma);
  Image<std::uint16_t> result = picture;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const float y = luma(u, v) + 128, cb = blue(u / columns, v / rows),
                  cr = red(u / columns, v / rows);
      const float rgb[] = {y + 1.402f * cr, y - 0.344136f * cb - 0.714136f * cr, y + 1.772f * cb};
      for (int c = 0; c < 3; ++c)
        result(u, v, c) = std::uint16_t(std::lround(std::clamp(rgb[c], 0.f, 255.f)));
    }
  return result;
}

/// Pictures as JPEG would leave them.
class JpegPixels : public PixelSource {
 public:
  JpegPixels(std::shared_ptr<const PixelSource> pixels, JpegSteps steps)
      : pixels_(std::move(pixels)), steps_(std::move(steps)) {}
  Image<std::uint16_t> read(int view_idx) const override {
    return jpeg_rounded(pixels_->read(view_idx), steps_);
  }
  bool has_mask() const override { return pixels_->has_mask(); }
  int bit_depth() const override { return 8; }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  JpegSteps steps_;
};

}  // namespace gigaray::testing_support
