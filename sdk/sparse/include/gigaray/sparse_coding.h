// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <string_view>

#include "gigaray/sparse_light_field.h"

namespace gigaray {

// Bytes of the two parts of a sparse light field, compressed with zstd; docs/formats.md has the
// layout. Every decoder throws Error(kBadInput) for bytes that can't be meant, with a text that a
// caller puts the name of the file before.

/// The tuples of one band, in their order.
std::string encode_tuples(const SparseShape& shape, int band, const TupleBand& tuples);
TupleBand decode_tuples(const SparseShape& shape, int band, std::string_view bytes);

/// The difference ΔE of some rows of a view: what makes `picture` out of `drawn`, both (v, u, c),
/// RGB. What is decoded differs from the picture by max_error at most in every channel; 0: not at
/// all.
std::string encode_difference(const Image<std::uint16_t>& picture,
                              const Image<std::uint16_t>& drawn, int bit_depth, int max_error);
Image<std::uint16_t> decode_difference(std::string_view bytes, const Image<std::uint16_t>& drawn,
                                       int bit_depth);

/// Any bytes. most: of what comes out.
std::string compressed(std::string_view bytes);
std::string decompressed(std::string_view bytes, std::size_t most);

}  // namespace gigaray
