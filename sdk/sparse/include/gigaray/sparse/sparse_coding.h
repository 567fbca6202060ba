// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <string_view>

#include "gigaray/core/api.h"
#include "gigaray/sparse/sparse_light_field.h"

namespace GIGARAY_API gigaray {

// Bytes of the two parts of a sparse light field, compressed with zstd; docs/formats.md has the
// layout. Every decoder throws Error(kBadInput) for bytes that can't be meant, with a text that a
// caller puts the name of the file before.

/// The tuples of one band, in their order.
/// memory_bytes: most that they may take, in memory as they are and unpacked.
std::string encode_tuples(const SparseShape& shape, int band, const TupleBand& tuples);
TupleBand decode_tuples(const SparseShape& shape, int band, std::string_view bytes,
                        double memory_bytes);

/// The difference ΔE of some rows of a view: what makes `picture` out of `drawn`, both (v, u, c),
/// RGB. What is decoded differs from the picture by max_error at most in every channel; 0: not at
/// all.
std::string encode_difference(const Image<std::uint16_t>& picture,
                              const Image<std::uint16_t>& drawn, int bit_depth, int max_error);
Image<std::uint16_t> decode_difference(std::string_view bytes, const Image<std::uint16_t>& drawn,
                                       int bit_depth);
/// Can so many bytes hold the difference of so many pixels? No code is shorter than what they need
/// at least.
bool may_hold_difference(std::uint64_t bytes, double pixels);

/// Any bytes. most: of what comes out; nothing is allocated for what states more, or another size
/// than its zstd frame does.
std::string compressed(std::string_view bytes);
std::string decompressed(std::string_view bytes, std::size_t most);

}  // namespace gigaray
