// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/error.h"

namespace GIGARAY_API gigaray {

/// width * height * channels. Throws Error: kInvalidArgument for a width or height below 0 or fewer
/// than one channel, kOutOfMemory for more than memory can count.
std::size_t image_size(int width, int height, int channels);
[[noreturn]] void throw_image_too_large(int width, int height, int channels);
[[noreturn]] void throw_wrong_pixel_count(int width, int height, int channels, std::size_t given);

/// A picture in memory that owns its pixels: rows from top to bottom, (v, u, c) with c fastest,
/// no padding.
template <class T>
class Image {
 public:
  Image() = default;
  /// Throws what image_size() throws, and Error(kOutOfMemory) where there is no memory for it.
  Image(int width, int height, int channels = 1, T value = T{})
      : width_(width),
        height_(height),
        channels_(channels),
        data_(filled(width, height, channels, value)) {}
  /// Takes pixels in their order. Throws Error(kInvalidArgument) for another number of them.
  Image(int width, int height, int channels, std::vector<T> pixels)
      : width_(width), height_(height), channels_(channels), data_(std::move(pixels)) {
    if (data_.size() != image_size(width, height, channels))
      throw_wrong_pixel_count(width, height, channels, data_.size());
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  bool empty() const { return data_.empty(); }
  std::size_t size() const { return data_.size(); }  ///< width * height * channels

  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }
  T* row(int v) { return data_.data() + std::size_t(v) * width_ * channels_; }
  const T* row(int v) const { return data_.data() + std::size_t(v) * width_ * channels_; }
  T& operator()(int u, int v, int c = 0) { return row(v)[std::size_t(u) * channels_ + c]; }
  const T& operator()(int u, int v, int c = 0) const {
    return row(v)[std::size_t(u) * channels_ + c];
  }

  auto begin() { return data_.begin(); }
  auto end() { return data_.end(); }
  auto begin() const { return data_.begin(); }
  auto end() const { return data_.end(); }
  bool operator==(const Image&) const = default;

 private:
  static std::vector<T> filled(int width, int height, int channels, T value) {
    const std::size_t size = image_size(width, height, channels);
    try {
      return std::vector<T>(size, value);
    } catch (const std::bad_alloc&) {
      throw_image_too_large(width, height, channels);
    } catch (const std::length_error&) {
      throw_image_too_large(width, height, channels);
    }
  }

  int width_ = 0;
  int height_ = 0;
  int channels_ = 1;
  std::vector<T> data_;
};

/// One value per pixel; NaN where there is none.
using FloatMap = Image<float>;
/// One byte per pixel: 0 no, 1 yes.
using Mask = Image<std::uint8_t>;

inline constexpr float kNoEstimate = std::numeric_limits<float>::quiet_NaN();

/// Rows [begin, end) of a picture.
struct RowRange {
  int begin = 0;
  int end = 0;
  int size() const { return end - begin; }
  bool contains(int v) const { return v >= begin && v < end; }
  bool operator==(const RowRange&) const = default;
};

/// The range grown by `halo` rows on both sides and clipped to [0, height).
inline RowRange grown(RowRange rows, int halo, int height) {
  return {rows.begin - halo < 0 ? 0 : rows.begin - halo,
          rows.end + halo > height ? height : rows.end + halo};
}

/// The rows that are in both; of size 0 where there are none.
inline RowRange overlap(RowRange a, RowRange b) {
  const RowRange both{a.begin > b.begin ? a.begin : b.begin, a.end < b.end ? a.end : b.end};
  return both.size() > 0 ? both : RowRange{};
}

}  // namespace gigaray
