// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// A tuple (m, u, v, s, t, r̄) of the sparse light field Γ (section 3): the line that a scene point
/// draws through the views. Integers, so that every machine draws the same picture.
struct SparseTuple {
  std::int32_t slope = 0;  ///< Disparity, 2^-slope_bits px per view step; larger is nearer.
  std::int32_t view = 0;   ///< The view that it was found in: its (s, t),
  std::int32_t u = 0;      ///< px of that view
  std::int32_t v = 0;      ///< px
  std::array<std::uint16_t, 3> colour{};  ///< Mean r̄ of what the views see: encoded RGB.
  bool operator==(const SparseTuple&) const = default;
};

/// What tuples mean: sizes and positions of a 3D or 4D light field in fixed point.
struct SparseShape {
  int width = 0, height = 0;
  int bit_depth = 8;
  int slope_bits = 0;       ///< Fraction bits of a slope, 0 … 20.
  int slope_tolerance = 0;  ///< Slopes that differ by no more are one surface.
  int band_rows = 0;        ///< Tuples are kept in bands of so many rows of their own view.
  struct Position {
    std::int64_t s = 0, t = 0;  ///< 2^-16 view steps
  };
  std::vector<Position> positions;  ///< of the views

  int num_bands() const { return (height + band_rows - 1) / band_rows; }
  RowRange band(int index) const {
    return {index * band_rows, std::min(height, (index + 1) * band_rows)};
  }
  static constexpr double kMostSlope = 1 << 30;
  double disparity(std::int32_t slope) const;
  std::int32_t slope(double disparity) const;  ///< the nearest
};

/// The shape for a light field: slopes fine enough that a point is drawn within 1/64 px of its
/// place in every view. Looks at no pixel. Throws Error(kInvalidArgument) for unstructured views
/// and for views more than 2^14 view steps away.
SparseShape sparse_shape(const LightField& light_field, int bit_depth, int band_rows);

/// The tuples of one band of rows, in order of rising disparity, that is of decreasing slope m of
/// eq. 1: from back to front.
struct TupleBand {
  std::vector<SparseTuple> tuples;
  std::int32_t least_slope = std::numeric_limits<std::int32_t>::max();
  std::int32_t largest_slope = std::numeric_limits<std::int32_t>::min();
};

/// Γ, by bands; as many as the shape has.
using SparseTuples = std::vector<TupleBand>;

/// What the tuples draw: the reconstruction Ẽ of some rows of a view.
struct DrawnRows {
  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
  RowRange rows;
  Image<std::int32_t> slope;    ///< (v − rows.begin, u); kNone where no tuple is seen
  Image<std::uint16_t> colour;  ///< (v − rows.begin, u, c); 0 there
};

/// Bands whose tuples `rows` of a view can show, among the bands that `has_tuples`' slopes reach.
std::vector<int> bands_reaching(const SparseShape& shape, const SparseTuples& tuples, int view,
                                RowRange rows);

/// Draws the tuples into some rows of a view from back to front: at every pixel the nearest surface
/// within 3/4 px, there the mean of its tuples with linear weights. The same bits on every machine,
/// however the rows are cut. Bands that don't reach the rows may be empty.
DrawnRows draw_tuples(const SparseShape& shape, const SparseTuples& tuples, int view,
                      RowRange rows);

/// How Γ is chosen.
struct SparseOptions {
  /// A ray is explained by a tuple whose colour differs by no more; encoded RGB in [0, 1].
  float tolerance = 0.1f;
  /// Rounds that fit the colours of the tuples to what the views show.
  int colour_rounds = 2;
};

/// Depth of a view: (v, u) disparity, NaN where there is none.
using DisparityOfView = std::function<FloatMap(int view_idx)>;

/// Chooses Γ: walks the views from the centre outwards, draws what the tuples so far explain and
/// adds one for every pixel that they don't, so that every ray with an estimate is explained, also
/// what the centre view does not see. Reads every picture 2 + colour_rounds times, one at a time.
SparseTuples choose_tuples(const LightField& light_field, const SparseShape& shape,
                           const DisparityOfView& disparity, const SparseOptions& options,
                           const RunControl& control);

std::size_t num_tuples(const SparseTuples& tuples);

}  // namespace gigaray
