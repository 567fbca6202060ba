// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "gigaray/core/arguments.h"
#include "tuple_ray.h"

namespace gigaray {
namespace {

constexpr double kPositionScale = 1 << 16;
/// Such places and slopes leave room in 64 bits.
constexpr double kFarthest = 1 << 14;  // view steps

/// Rows that a tuple may be away from those of its band in another view.
struct Reach {
  std::int64_t least, most;
};

void check_rows(const SparseShape& shape, const SparseTuples& tuples, int view, RowRange rows) {
  require_argument(shape.band_rows >= 1 && tuples.size() == std::size_t(shape.num_bands()),
                   "tuples: a band of them for each band of the shape is needed");
  require_argument(view >= 0 && std::size_t(view) < shape.positions.size(),
                   "view: the shape has no such view");
  require_argument(rows.begin >= 0 && rows.begin <= rows.end && rows.end <= shape.height,
                   "rows: must be rows of the picture");
}

Reach reach_of(const SparseShape& shape, const TupleBand& band, std::int64_t way) {
  const auto at = [&](std::int32_t slope) { return fixed_shift(way, slope, shape.slope_bits); };
  const std::int64_t a = at(band.least_slope), b = at(band.largest_slope);
  return {(std::min(a, b) >> kPlaceBits) - 1, (std::max(a, b) >> kPlaceBits) + 2};
}

/// Calls visit(u, v, weight) for the pixels of `rows` that the place lies between; weight
/// 1 … 2^(2·kPlaceBits), is_near: within 3/4 px.
template <class Visit>
void for_each_pixel_near(const SparseShape& shape, RowRange rows, TuplePlace place, Visit visit) {
  const std::int64_t u0 = place.u >> kPlaceBits, v0 = place.v >> kPlaceBits;
  const int part_u = int(place.u & (kPlaceOne - 1)), part_v = int(place.v & (kPlaceOne - 1));
  for (int j = 0; j < 2; ++j) {
    const std::int64_t v = v0 + j;
    const int weight_v = j ? part_v : kPlaceOne - part_v;
    if (weight_v == 0 || v < rows.begin || v >= rows.end) continue;
    for (int i = 0; i < 2; ++i) {
      const std::int64_t u = u0 + i;
      const int weight_u = i ? part_u : kPlaceOne - part_u;
      if (weight_u == 0 || u < 0 || u >= shape.width) continue;
      visit(int(u), int(v), weight_u * weight_v, std::min(weight_u, weight_v) >= kPlaceOne / 4);
    }
  }
}

}  // namespace

double SparseShape::disparity(std::int32_t slope) const {
  return std::ldexp(double(slope), -slope_bits);
}

std::int32_t SparseShape::slope(double disparity) const {
  return std::int32_t(
      std::lround(std::clamp(std::ldexp(disparity, slope_bits), -kMostSlope, kMostSlope)));
}

SparseShape sparse_shape(const LightField& light_field, int bit_depth, int band_rows) {
  require_argument(bit_depth >= 1 && bit_depth <= 16, "bit_depth: must be between 1 and 16");
  require_argument(band_rows >= 1, "band_rows: must be 1 or more");
  require_argument(
      light_field.width >= 1 && light_field.height >= 1 && light_field.num_views() >= 2,
      "light_field: two views or more with pixels are needed");
  if (light_field.kind == LightFieldKind::kUnstructured)
    throw Error(ErrorCode::kInvalidArgument,
                "a sparse light field holds 3D and 4D light fields, not photographs from anywhere");
  SparseShape shape;
  shape.width = light_field.width;
  shape.height = light_field.height;
  shape.bit_depth = bit_depth;
  shape.band_rows = band_rows;
  for (const View& view : light_field.views) {
    if (!(std::abs(view.s) <= kFarthest && std::abs(view.t) <= kFarthest))
      throw Error(ErrorCode::kInvalidArgument,
                  "view " + view.name + " stands too far away for a sparse light field: " +
                      std::to_string(int(kFarthest)) + " view steps are the most");
    shape.positions.push_back(
        {std::llround(view.s * kPositionScale), std::llround(view.t * kPositionScale)});
  }
  double extent = 1;
  for (const auto axis : {&View::s, &View::t}) {
    const auto [least, most] =
        std::minmax_element(light_field.views.begin(), light_field.views.end(),
                            [&](const View& a, const View& b) { return a.*axis < b.*axis; });
    extent = std::max(extent, (*most).*axis - (*least).*axis);
  }
  // Half a step times the extent is 1/64 px at most.
  shape.slope_bits = std::clamp(int(std::ceil(std::log2(32 * extent))), 0, 20);
  shape.slope_tolerance = int(std::ceil(std::ldexp(1 / extent, shape.slope_bits)));
  return shape;
}

std::vector<int> bands_reaching(const SparseShape& shape, const SparseTuples& tuples, int view,
                                RowRange rows) {
  check_rows(shape, tuples, view, rows);
  std::vector<int> bands;
  for (int i = 0; i < shape.num_bands(); ++i) {
    if (tuples[i].least_slope > tuples[i].largest_slope) continue;
    const RowRange band = shape.band(i);
    const bool reaches = std::any_of(
        shape.positions.begin(), shape.positions.end(), [&](const SparseShape::Position& from) {
          const Reach reach = reach_of(shape, tuples[i], from.t - shape.positions[view].t);
          return band.begin + reach.least < rows.end && band.end + reach.most > rows.begin;
        });
    if (reaches) bands.push_back(i);
  }
  return bands;
}

DrawnRows draw_tuples(const SparseShape& shape, const SparseTuples& tuples, int view,
                      RowRange rows) {
  check_rows(shape, tuples, view, rows);
  DrawnRows drawn{rows, Image<std::int32_t>(shape.width, rows.size(), 1, DrawnRows::kNone),
                  Image<std::uint16_t>(shape.width, rows.size(), 3)};
  const std::vector<int> bands = bands_reaching(shape, tuples, view, rows);
  const auto for_each_place = [&](auto visit) {
    for (const int band : bands)
      for (const SparseTuple& tuple : tuples[band].tuples)
        visit(tuple, place_in(shape, tuple, view));
  };

  for_each_place([&](const SparseTuple& tuple, TuplePlace place) {
    for_each_pixel_near(shape, rows, place, [&](int u, int v, int, bool is_near) {
      std::int32_t& front = drawn.slope(u, v - rows.begin);
      if (is_near) front = std::max(front, tuple.slope);
    });
  });

  struct Sum {
    std::uint64_t weight = 0;
    std::array<std::uint64_t, 3> colour{};
  };
  std::vector<Sum> sums(std::size_t(shape.width) * rows.size());
  for_each_place([&](const SparseTuple& tuple, TuplePlace place) {
    for_each_pixel_near(shape, rows, place, [&](int u, int v, int weight, bool) {
      const std::int32_t front = drawn.slope(u, v - rows.begin);
      if (front == DrawnRows::kNone || std::abs(front - tuple.slope) > shape.slope_tolerance)
        return;
      Sum& sum = sums[std::size_t(v - rows.begin) * shape.width + u];
      sum.weight += weight;
      for (int c = 0; c < 3; ++c) sum.colour[c] += std::uint64_t(weight) * tuple.colour[c];
    });
  });
  std::uint16_t* colour = drawn.colour.data();
  for (const Sum& sum : sums) {
    if (sum.weight > 0)
      for (int c = 0; c < 3; ++c)
        colour[c] = std::uint16_t((sum.colour[c] + sum.weight / 2) / sum.weight);
    colour += 3;
  }
  return drawn;
}

}  // namespace gigaray
