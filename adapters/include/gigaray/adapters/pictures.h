// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// How stored values become those of a light field, the same way for all of its views.
struct ValueScale {
  int bits_of_16 = 16;   ///< of 16-bit integers: 2^bits − 1 is full scale
  int bits_of_32 = 32;   ///< of 32-bit integers
  float full_light = 1;  ///< linear light that is full scale; sRGB from there on
};

/// Writes a PNG, whole or not at all. picture: 1 (grey) or 3 (RGB) channels, values
/// 0 … 2^bit_depth − 1; bit_depth 8 or 16. Throws Error(kIo) when the place can't be written.
void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& picture,
               int bit_depth);

/// The same as bytes of a file.
std::string png_bytes(const Image<std::uint16_t>& picture, int bit_depth);

/// A JPEG with full colour resolution as bytes of a file. picture: RGB; quality 1 … 100. Throws
/// Error(kInvalidArgument) for a picture with more than 65,500 px on a side.
std::string jpeg_bytes(const Image<std::uint8_t>& picture, int quality);

/// Reads any picture that a light field may be made of: RGB (v, u, c); grey is repeated, alpha is
/// dropped, the orientation of the camera is applied. bit_depth, if given, becomes 8 or 16.
/// Throws Error(kBadInput) naming the file when it is damaged, cut short, no picture or takes more
/// than memory_bytes (0: default_memory_limit()) to decode.
Image<std::uint16_t> read_picture(const std::filesystem::path& path, int* bit_depth = nullptr,
                                  double memory_bytes = 0);

}  // namespace gigaray
