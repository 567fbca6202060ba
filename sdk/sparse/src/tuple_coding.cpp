// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Tuples as columns of small numbers: each as its difference from the tuple before it.
#include <algorithm>

#include "bytes.h"
#include "gigaray/core/arguments.h"
#include "gigaray/sparse/sparse_coding.h"

namespace gigaray {
namespace {

enum Column { kSlope, kView, kRow, kPlace, kRed, kGreen, kBlue, kColumns };

void check_band(const SparseShape& shape, int band) {
  require_argument(shape.band_rows >= 1 && band >= 0 && band < shape.num_bands(),
                   "band: the shape has no such band");
}

}  // namespace

std::string encode_tuples(const SparseShape& shape, int band, const TupleBand& tuples) {
  check_band(shape, band);
  ByteWriter columns[kColumns];
  SparseTuple last;
  last.v = shape.band(band).begin;
  for (const SparseTuple& tuple : tuples.tuples) {
    const bool same_slope = tuple.slope == last.slope;
    const bool same_view = same_slope && tuple.view == last.view;
    const bool same_row = same_view && tuple.v == last.v;
    columns[kSlope].signed_number(std::int64_t(tuple.slope) - last.slope);
    columns[kView].number(same_slope ? tuple.view - last.view : tuple.view);
    columns[kRow].number(tuple.v - (same_view ? last.v : shape.band(band).begin));
    columns[kPlace].number(same_row ? tuple.u - last.u : tuple.u);
    // Red and blue go with green.
    const int green = tuple.colour[1] - last.colour[1];
    columns[kGreen].signed_number(green);
    columns[kRed].signed_number(tuple.colour[0] - last.colour[0] - green);
    columns[kBlue].signed_number(tuple.colour[2] - last.colour[2] - green);
    last = tuple;
  }
  ByteWriter out;
  out.number(tuples.tuples.size());
  for (ByteWriter& column : columns) out.block(column.take());
  return out.take();
}

TupleBand decode_tuples(const SparseShape& shape, int band, std::string_view bytes,
                        double memory_bytes) {
  check_band(shape, band);
  const RowRange rows = shape.band(band);
  ByteReader in(bytes);
  const std::size_t most = std::size_t(rows.size()) * shape.width * shape.positions.size();
  const std::size_t count = in.number(most);
  double left = memory_bytes - double(count) * sizeof(SparseTuple);
  if (!(left >= 0)) damaged("it has more tuples than the limit of memory has room for");
  std::vector<std::string> blocks;
  for (int i = 0; i < kColumns; ++i) {
    const auto room = std::size_t(std::min(left, 10.0 * double(count)));
    blocks.push_back(in.block(room));
    left -= double(blocks.back().size());
    if (blocks.back().size() < count) damaged("it has fewer numbers than tuples");
  }
  if (!in.at_end()) damaged("more follows than it should have");
  std::vector<ByteReader> columns(blocks.begin(), blocks.end());

  TupleBand tuples;
  tuples.tuples.reserve(count);
  SparseTuple last;
  last.v = rows.begin;
  const std::int64_t most_colour = (std::int64_t(1) << shape.bit_depth) - 1;
  const auto colour = [&](std::int64_t value) {
    if (value < 0 || value > most_colour) damaged("a tuple has no colour");
    return std::uint16_t(value);
  };
  constexpr auto kMostSlope = std::int64_t(SparseShape::kMostSlope);
  for (std::size_t i = 0; i < count; ++i) {
    SparseTuple tuple;
    const std::int64_t step = columns[kSlope].signed_number(2 * kMostSlope);
    if (std::abs(last.slope + step) > kMostSlope || (i > 0 && step < 0))
      damaged("the tuples are not in order");
    tuple.slope = std::int32_t(last.slope + step);
    const bool same_slope = tuple.slope == last.slope;
    const std::size_t num_views = shape.positions.size();
    tuple.view = int(columns[kView].number(num_views) + (same_slope ? last.view : 0));
    const bool same_view = same_slope && tuple.view == last.view;
    tuple.v = int(columns[kRow].number(shape.height)) + (same_view ? last.v : rows.begin);
    const bool same_row = same_view && tuple.v == last.v;
    tuple.u = int(columns[kPlace].number(shape.width)) + (same_row ? last.u : 0);
    if (tuple.view >= int(num_views) || tuple.v >= rows.end || tuple.u >= shape.width)
      damaged("a tuple lies outside of the light field");
    const std::int64_t green = columns[kGreen].signed_number(4 * most_colour);
    tuple.colour[1] = colour(last.colour[1] + green);
    tuple.colour[0] = colour(last.colour[0] + green + columns[kRed].signed_number(4 * most_colour));
    tuple.colour[2] =
        colour(last.colour[2] + green + columns[kBlue].signed_number(4 * most_colour));
    tuples.tuples.push_back(tuple);
    tuples.least_slope = std::min(tuples.least_slope, tuple.slope);
    tuples.largest_slope = std::max(tuples.largest_slope, tuple.slope);
    last = tuple;
  }
  for (const ByteReader& column : columns)
    if (!column.at_end()) damaged("more follows than it should have");
  return tuples;
}

}  // namespace gigaray
