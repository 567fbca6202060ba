// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "gigaray/core/light_field.h"

namespace gigaray::testing_support {

/// Some pixels of every picture show nothing: they are black, the same under the disparity 0, and
/// masked.
class PicturesWithHoles : public PixelSource {
 public:
  PicturesWithHoles(std::shared_ptr<const PixelSource> pixels,
                    std::function<bool(int u, int v)> is_hole)
      : pixels_(std::move(pixels)), is_hole_(std::move(is_hole)) {}
  int bit_depth() const override { return pixels_->bit_depth(); }
  bool has_mask() const override { return true; }
  Image<std::uint16_t> read(int view_idx) const override {
    const Image<std::uint16_t> whole = pixels_->read(view_idx);
    Image<std::uint16_t> picture(whole.width(), whole.height(), 4);
    for (int v = 0; v < whole.height(); ++v)
      for (int u = 0; u < whole.width(); ++u)
        for (int c = 0; c < picture.channels(); ++c)
          picture(u, v, c) = is_hole_(u, v) ? 0 : c == 3 ? 255 : whole(u, v, c);
    return picture;
  }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  std::function<bool(int u, int v)> is_hole_;
};

/// Columns [begin, end), as the strap of a camera would hide them.
inline std::shared_ptr<const PixelSource> with_bar(std::shared_ptr<const PixelSource> pixels,
                                                   int begin, int end) {
  return std::make_shared<PicturesWithHoles>(std::move(pixels),
                                             [=](int u, int) { return u >= begin && u < end; });
}

}  // namespace gigaray::testing_support
