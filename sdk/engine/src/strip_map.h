// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "gigaray/core/image.h"

namespace gigaray {

/// Columns of padding left and right of every row of a map.
inline constexpr int kMapPad = 32;
/// Values from row to row of a map: the padding included, a multiple of 16.
inline int map_pitch(int width) { return (width + 2 * kMapPad + 15) / 16 * 16; }

/// Some rows of a map in the host's memory, owned by somebody else.
template <class T>
class MapView {
 public:
  MapView() = default;
  /// data: the first stored value of row `rows.begin`, padding included.
  MapView(T* data, int width, RowRange rows)
      : data_(data), width_(width), pitch_(map_pitch(width)), rows_(rows) {}
  template <class U>
  requires std::is_same_v<const U, T> MapView(const MapView<U>& other)
      : MapView(other.padded_row(other.rows().begin), other.width(), other.rows()) {}

  int width() const { return width_; }
  int pitch() const { return pitch_; }
  RowRange rows() const { return rows_; }
  T* padded_row(int v) const { return data_ + std::size_t(v - rows_.begin) * pitch_; }
  T* row(int v) const { return padded_row(v) + kMapPad; }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int pitch_ = 0;
  RowRange rows_;
};

/// Values of some rows of one view in the host's memory, in the layout of the kernels: `pitch`
/// values per row, pixel u at kMapPad + u, zero elsewhere (kernels read beyond the edges but don't
/// use what is there).
template <class T>
class StripMap {
 public:
  StripMap() = default;
  StripMap(int width, RowRange rows)
      : width_(width), rows_(rows), data_(std::size_t(map_pitch(width)) * rows.size()) {}

  int width() const { return width_; }
  int pitch() const { return map_pitch(width_); }
  RowRange rows() const { return rows_; }
  T* row(int v) { return view().row(v); }
  const T* row(int v) const { return const_cast<StripMap*>(this)->row(v); }
  /// First stored value of a row, padding included: what kernels get.
  T* padded_row(int v) { return row(v) - kMapPad; }
  const T* padded_row(int v) const { return row(v) - kMapPad; }

  MapView<T> view() { return {data_.data(), width_, rows_}; }
  operator MapView<T>() { return view(); }
  operator MapView<const T>() const { return const_cast<StripMap*>(this)->view(); }

 private:
  int width_ = 0;
  RowRange rows_;
  std::vector<T> data_;
};

}  // namespace gigaray
