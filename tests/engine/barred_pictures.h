// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <utility>

#include "gigaray/light_field.h"

namespace gigaray::testing_support {

/// A bar that stands at the same place in every picture, as the strap of a camera would: columns
/// [begin, end) are black, the same under the disparity 0, and masked.
class BarredPictures : public PixelSource {
 public:
  BarredPictures(std::shared_ptr<const PixelSource> pixels, int begin, int end)
      : pixels_(std::move(pixels)), begin_(begin), end_(end) {}
  int bit_depth() const override { return pixels_->bit_depth(); }
  bool has_mask() const override { return true; }
  Image<std::uint16_t> read(int view_idx) const override {
    const Image<std::uint16_t> whole = pixels_->read(view_idx);
    Image<std::uint16_t> picture(whole.width(), whole.height(), 4);
    for (int v = 0; v < whole.height(); ++v)
      for (int u = 0; u < whole.width(); ++u)
        for (int c = 0; c < picture.channels(); ++c)
          picture(u, v, c) = u >= begin_ && u < end_ ? 0 : c == 3 ? 255 : whole(u, v, c);
    return picture;
  }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  int begin_, end_;
};

}  // namespace gigaray::testing_support
