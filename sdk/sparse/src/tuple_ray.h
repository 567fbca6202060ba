// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/sparse/sparse_light_field.h"

namespace gigaray {

/// Fraction bits of a place in a picture.
inline constexpr int kPlaceBits = 8;
inline constexpr int kPlaceOne = 1 << kPlaceBits;

/// Where a view sees the point of a tuple, 2^-kPlaceBits px.
struct TuplePlace {
  std::int64_t u, v;
};

/// way: 2^-16 view steps; result: 2^-kPlaceBits px.
inline std::int64_t fixed_shift(std::int64_t way, std::int32_t slope, int slope_bits) {
  const int surplus = 16 + slope_bits - kPlaceBits;
  return (way * slope + (std::int64_t(1) << (surplus - 1))) >> surplus;
}

/// u + (ŝ − s)·d, v + (t̂ − t)·d (eq. 3, 9).
inline TuplePlace place_in(const SparseShape& shape, const SparseTuple& tuple, int view) {
  const SparseShape::Position& from = shape.positions[tuple.view];
  const SparseShape::Position& to = shape.positions[view];
  return {(std::int64_t(tuple.u) << kPlaceBits) +
              fixed_shift(from.s - to.s, tuple.slope, shape.slope_bits),
          (std::int64_t(tuple.v) << kPlaceBits) +
              fixed_shift(from.t - to.t, tuple.slope, shape.slope_bits)};
}

}  // namespace gigaray
