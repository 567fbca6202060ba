// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <string>

#include "gigaray/image.h"

namespace gigaray {

/// The content of a PNG file. picture: 1 (grey) or 3 (RGB) channels, 0 … 2^bit_depth − 1; bit_depth
/// 8 or 16.
std::string png_bytes(const Image<std::uint16_t>& picture, int bit_depth);

}  // namespace gigaray
