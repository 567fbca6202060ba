// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "gigaray/image.h"

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

struct ExrHeader {
  int width = 0, height = 0;  ///< of the window with data
  double chunk_pixels = 0;    ///< that are decoded at once
};
/// Looks through the header of an OpenEXR file by itself, since the library takes the sizes of
/// attributes and tables as they are stated. bytes: the first ones of a file of file_size.
ExrHeader parse_exr_header(std::string_view bytes, std::uint64_t file_size,
                           const std::string& where);
/// A map of one channel. limit: bytes it may take.
FloatMap parse_exr(const std::string& bytes, const std::string& where, double limit);

}  // namespace gigaray
