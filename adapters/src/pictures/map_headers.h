// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/core/image.h"

namespace gigaray {

// What files of maps say before their values. Everything throws Error(kBadInput) beginning with
// `where`.

struct PfmHeader {
  int width = 0, height = 0;
  std::endian order = std::endian::little;
  std::size_t size = 0;  ///< bytes before the floats
};
/// bytes: the first ones of a file of file_size, which must be what the header states.
PfmHeader parse_pfm_header(std::string_view bytes, std::uint64_t file_size,
                           const std::string& where);

struct ExrChannel {
  std::string name;     ///< "R", "layer.R"
  bool is_full = true;  ///< a value for every pixel
};
struct ExrHeader {
  int width = 0, height = 0;  ///< of the window with data
  int left = 0, top = 0;      ///< its first pixel
  /// The window that is shown: its first pixel and size. That with data where none is stated.
  int shown_left = 0, shown_top = 0, shown_width = 0, shown_height = 0;
  double chunk_pixels = 0;  ///< that are decoded at once
  std::vector<ExrChannel> channels;
};
/// Looks through the header of an OpenEXR file by itself, since the library takes the sizes of
/// attributes and tables as they are stated. bytes: the first ones of a file of file_size.
ExrHeader parse_exr_header(std::string_view bytes, std::uint64_t file_size,
                           const std::string& where);
/// A map of one channel. limit: bytes it may take.
FloatMap parse_exr(const std::string& bytes, const std::string& where, double limit);
/// Some channels by name, (v, u, c), of the window with data. header: of these bytes.
Image<float> parse_exr_channels(const std::string& bytes, const ExrHeader& header,
                                const std::vector<std::string>& channels, const std::string& where,
                                double limit);

}  // namespace gigaray
