// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/sparse/sparse_light_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/analytic_field.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::analytic_field;
using testing_support::AnalyticField;
using testing_support::expect_error;
using testing_support::grid_of_views;
using testing_support::irregular_grid;
using testing_support::row_of_views;

constexpr int kWidth = 93, kHeight = 47;

SparseTuples choose(const AnalyticField& field, const SparseShape& shape,
                    const SparseOptions& options = {}) {
  return choose_tuples(field.light_field, shape, [&](int view) { return field.disparity[view]; },
                       options, {});
}

/// A near patch over a far plane.
AnalyticField two_layers(std::vector<View> views) {
  return analytic_field(kWidth, kHeight, std::move(views),
                        {{-0.5, 1}, {1.3, 2, 1, 30, 60, 12, 33}});
}

/// Painting from back to front: the plain meaning of draw_tuples.
DrawnRows draw_plainly(const SparseShape& shape, const SparseTuples& tuples, int view) {
  std::vector<SparseTuple> all;
  for (const TupleBand& band : tuples)
    all.insert(all.end(), band.tuples.begin(), band.tuples.end());
  const auto place = [&](const SparseTuple& tuple, auto axis, int at) {
    const double from = double(shape.positions[tuple.view].*axis) / 65536;
    const double to = double(shape.positions[view].*axis) / 65536;
    return std::floor((at + (from - to) * shape.disparity(tuple.slope)) * 256 + 0.5) / 256;
  };
  DrawnRows drawn{{0, shape.height},
                  Image<std::int32_t>(shape.width, shape.height, 1, DrawnRows::kNone),
                  Image<std::uint16_t>(shape.width, shape.height, 3)};
  for (int v = 0; v < shape.height; ++v)
    for (int u = 0; u < shape.width; ++u) {
      std::int32_t front = DrawnRows::kNone;
      const auto distance = [&](const SparseTuple& tuple) {
        return std::max(std::abs(place(tuple, &SparseShape::Position::s, tuple.u) - u),
                        std::abs(place(tuple, &SparseShape::Position::t, tuple.v) - v));
      };
      for (const SparseTuple& tuple : all)
        if (distance(tuple) <= 0.75) front = std::max(front, tuple.slope);
      if (front == DrawnRows::kNone) continue;
      double weights = 0, sums[3] = {};
      for (const SparseTuple& tuple : all) {
        if (std::abs(tuple.slope - front) > shape.slope_tolerance || distance(tuple) >= 1) continue;
        const double weight = (1 - std::abs(place(tuple, &SparseShape::Position::s, tuple.u) - u)) *
                              (1 - std::abs(place(tuple, &SparseShape::Position::t, tuple.v) - v));
        weights += weight;
        for (int c = 0; c < 3; ++c) sums[c] += weight * tuple.colour[c];
      }
      drawn.slope(u, v) = front;
      for (int c = 0; c < 3; ++c)
        drawn.colour(u, v, c) = std::uint16_t(std::floor(sums[c] / weights + 0.5));
    }
  return drawn;
}

TEST(SparseLightField, DrawsAsPaintingFromBackToFrontWould) {
  const AnalyticField field =
      analytic_field(27, 15, irregular_grid(), {{-0.5, 1}, {1.3, 2, 1, 8, 20, 4, 11}});
  const SparseShape shape = sparse_shape(field.light_field, 8, 4);
  const SparseTuples tuples = choose(field, shape);
  for (int view = 0; view < field.light_field.num_views(); ++view) {
    const DrawnRows plain = draw_plainly(shape, tuples, view);
    const DrawnRows drawn = draw_tuples(shape, tuples, view, {0, shape.height});
    EXPECT_TRUE(drawn.slope == plain.slope) << view;
    EXPECT_TRUE(drawn.colour == plain.colour) << view;
  }
}

TEST(SparseLightField, DrawingDoesNotDependOnHowTheRowsAreCut) {
  const AnalyticField field = two_layers(irregular_grid());
  const SparseShape shape = sparse_shape(field.light_field, 8, 10);
  const SparseTuples tuples = choose(field, shape);
  const DrawnRows all = draw_tuples(shape, tuples, 3, {0, kHeight});
  for (const RowRange rows : {RowRange{0, 1}, RowRange{9, 21}, RowRange{40, kHeight}}) {
    const DrawnRows part = draw_tuples(shape, tuples, 3, rows);
    EXPECT_TRUE(std::equal(part.slope.begin(), part.slope.end(), all.slope.row(rows.begin)));
    EXPECT_TRUE(std::equal(part.colour.begin(), part.colour.end(), all.colour.row(rows.begin)));
  }
}

TEST(SparseLightField, ExplainsEveryRayOfEveryViewAlsoWhatTheCentreDoesNotSee) {
  for (const auto& views : {row_of_views(9), grid_of_views(3, 3), irregular_grid()}) {
    const AnalyticField field = two_layers(views);
    const SparseShape shape = sparse_shape(field.light_field, 8, 16);
    const SparseTuples tuples = choose(field, shape);
    const int centre = centre_view(field.light_field);
    std::size_t outside_centre = 0;
    for (const TupleBand& band : tuples)
      outside_centre += std::count_if(band.tuples.begin(), band.tuples.end(),
                                      [&](const SparseTuple& t) { return t.view != centre; });
    EXPECT_GT(outside_centre, 0u);
    for (int view = 0; view < field.light_field.num_views(); ++view) {
      const DrawnRows drawn = draw_tuples(shape, tuples, view, {0, kHeight});
      EXPECT_EQ(std::count(drawn.slope.begin(), drawn.slope.end(), DrawnRows::kNone), 0) << view;
    }
  }
}

TEST(SparseLightField, TuplesAreFewAndInOrderOfRisingDisparity) {
  const AnalyticField field = two_layers(row_of_views(9));
  const SparseShape shape = sparse_shape(field.light_field, 8, 16);
  const SparseTuples tuples = choose(field, shape);
  // One picture and what is hidden in it and beside it, of nine.
  EXPECT_LT(double(num_tuples(tuples)), 1.35 * kWidth * kHeight);
  for (const TupleBand& band : tuples) {
    EXPECT_TRUE(std::is_sorted(
        band.tuples.begin(), band.tuples.end(),
        [](const SparseTuple& a, const SparseTuple& b) { return a.slope < b.slope; }));
    EXPECT_EQ(band.least_slope, band.tuples.front().slope);
    EXPECT_EQ(band.largest_slope, band.tuples.back().slope);
  }
}

TEST(SparseLightField, DrawnDisparityIsThatOfTheViewToHalfAStep) {
  const AnalyticField field = two_layers(row_of_views(5));
  const SparseShape shape = sparse_shape(field.light_field, 8, 16);
  const SparseTuples tuples = choose(field, shape);
  const double half_step = std::ldexp(0.5, -shape.slope_bits);
  int wrong = 0;
  for (int view = 0; view < 5; ++view) {
    const DrawnRows drawn = draw_tuples(shape, tuples, view, {0, kHeight});
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        wrong += std::abs(shape.disparity(drawn.slope(u, v)) - field.disparity[view](u, v)) >
                 half_step + 1e-6;
  }
  // Tuples reach 3/4 px, half a pixel is the true width: silhouettes may be off by one.
  EXPECT_LT(wrong, 5 * 2 * (33 - 12 + 2));
}

TEST(SparseLightField, FittedColoursComeNearerToThePictures) {
  const AnalyticField field = analytic_field(kWidth, kHeight, row_of_views(7), {{0.7, 3}}, 8, 0.02);
  const SparseShape shape = sparse_shape(field.light_field, 8, 16);
  const auto error = [&](int rounds) {
    SparseOptions options;
    options.colour_rounds = rounds;
    const SparseTuples tuples = choose(field, shape, options);
    double sum = 0;
    for (int view = 0; view < 7; ++view) {
      const DrawnRows drawn = draw_tuples(shape, tuples, view, {0, kHeight});
      const Image<std::uint16_t> picture = read_view(field.light_field, view);
      for (std::size_t i = 0; i < picture.size(); ++i)
        sum += std::abs(double(picture.data()[i]) - drawn.colour.data()[i]);
    }
    return sum;
  };
  EXPECT_LT(error(2), 0.9 * error(0));
}

TEST(SparseLightField, RaysWithoutAnEstimateAreLeftOut) {
  AnalyticField field = two_layers(row_of_views(3));
  for (FloatMap& map : field.disparity) std::fill(map.begin(), map.end(), kNoEstimate);
  const SparseShape shape = sparse_shape(field.light_field, 8, 16);
  EXPECT_EQ(num_tuples(choose(field, shape)), 0u);
  const DrawnRows drawn = draw_tuples(shape, choose(field, shape), 0, {0, kHeight});
  EXPECT_EQ(std::count(drawn.slope.begin(), drawn.slope.end(), DrawnRows::kNone), kWidth * kHeight);
}

TEST(SparseLightField, SlopesAreFineEnoughForAWideRig) {
  const AnalyticField field = two_layers(row_of_views(9));
  const SparseShape shape = sparse_shape(field.light_field, 8, 16);
  // Half a step, over the whole rig.
  EXPECT_LE(std::ldexp(0.5, -shape.slope_bits) * 8, 1.0 / 64);
}

TEST(SparseLightField, UnstructuredViewsAreRefused) {
  LightField field = two_layers(row_of_views(3)).light_field;
  field.kind = LightFieldKind::kUnstructured;
  expect_error(ErrorCode::kInvalidArgument, {"3D and 4D"}, [&] { sparse_shape(field, 8, 16); });
}

}  // namespace
}  // namespace gigaray
