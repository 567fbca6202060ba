// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// A picture in memory of somebody else, of any layout: rows with padding, planes, BGR (start at
/// the last channel, stride_c below 0), upside down. A view is as cheap to copy as a pointer.
template <class T>
struct ImageView {
  T* data = nullptr;                                        ///< of (u, v, c) = (0, 0, 0)
  int width = 0, height = 0, channels = 0;                  ///< px
  std::ptrdiff_t stride_u = 0, stride_v = 0, stride_c = 0;  ///< bytes to the next u, v, c

  ImageView() = default;
  /// Rows from top to bottom, (v, u, c) with c fastest; stride_v: bytes of a row, 0: no padding.
  ImageView(T* pixels, int width, int height, int channels, std::ptrdiff_t stride_v = 0)
      : data(pixels),
        width(width),
        height(height),
        channels(channels),
        stride_u(channels * std::ptrdiff_t(sizeof(T))),
        stride_v(stride_v != 0 ? stride_v : width * stride_u),
        stride_c(sizeof(T)) {}
  ImageView(const Image<std::remove_const_t<T>>& image) requires std::is_const_v<T>
      : ImageView(image.data(), image.width(), image.height(), image.channels()) {}

  T& operator()(int u, int v, int c = 0) const {
    using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
    return *reinterpret_cast<T*>(reinterpret_cast<Byte*>(data) + u * stride_u + v * stride_v +
                                 c * stride_c);
  }
};

/// Pictures that stay where they are, in 8 or 16 bits, one per view: what a light field's `pixels`
/// can be. They are widened picture by picture as they are read. 1 channel is grey; of more than 3
/// the first three count. `owner` is kept as long as they are; without one they must outlive the
/// light field. Throws Error(kInvalidArgument) where sizes or channels differ, or there is no data.
std::shared_ptr<const PixelSource> pixels_of_views(
    std::vector<ImageView<const std::uint8_t>> pictures, std::shared_ptr<const void> owner = {});
std::shared_ptr<const PixelSource> pixels_of_views(
    std::vector<ImageView<const std::uint16_t>> pictures, std::shared_ptr<const void> owner = {});

}  // namespace gigaray
