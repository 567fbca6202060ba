// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>

namespace gigaray {

/// Reads `count` values of type T in the given byte order.
template <class T = float, class To>
void load_floats(const char* bytes, std::endian order, To* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    char raw[sizeof(T)];
    std::copy_n(bytes + i * sizeof(T), sizeof(T), raw);
    if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    values[i] = To(std::bit_cast<T>(raw));
  }
}

/// Appends values in little endian.
inline void append_floats(std::string& bytes, const float* values, std::size_t count) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(float));
}

}  // namespace gigaray
