// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <limits>

#include "gigaray/sparse/sparse_coding.h"
#include "gigaray/sparse/sparse_light_field.h"
#include "support/black_views.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

LightField two_views() { return testing_support::black_views(2); }

TEST(MistakesOfSparse, AShapeThatIsNone) {
  expect_mistake("bits", [] { sparse_shape(two_views(), 0, 4); });
  expect_mistake("bits", [] { sparse_shape(two_views(), 17, 4); });
  expect_mistake("rows", [] { sparse_shape(two_views(), 8, 0); });
  expect_mistake("empty", [] { sparse_shape(LightField(), 8, 4); });
  LightField far = two_views();
  far.views[1].s = std::numeric_limits<double>::quiet_NaN();
  expect_mistake("NaN", [&] { sparse_shape(far, 8, 4); });
  far.kind = LightFieldKind::kUnstructured;
  expect_mistake("unstructured", [&] { sparse_shape(far, 8, 4); });
}

TEST(MistakesOfSparse, TuplesOfAnotherShape) {
  const LightField field = two_views();
  const SparseShape shape = sparse_shape(field, 8, 4);
  const SparseTuples tuples(std::size_t(shape.num_bands()));
  const RowRange rows{0, 5};
  expect_mistake("bands", [&] { draw_tuples(shape, {}, 0, rows); });
  expect_mistake("bands", [&] { bands_reaching(shape, {}, 0, rows); });
  for (const int view : {-1, 2}) {
    expect_mistake("view", [&] { draw_tuples(shape, tuples, view, rows); });
    expect_mistake("view", [&] { bands_reaching(shape, tuples, view, rows); });
  }
  for (const RowRange wrong : {RowRange{-1, 3}, RowRange{3, 1}, RowRange{0, 6}})
    expect_mistake("rows", [&] { draw_tuples(shape, tuples, 0, wrong); });
  const auto flat = [](int) { return FloatMap(7, 5); };
  const auto small = [](int) { return FloatMap(3, 3); };
  const RunControl control;
  expect_mistake("empty", [&] { choose_tuples(field, shape, {}, {}, control); });
  expect_mistake("size", [&] { choose_tuples(field, shape, small, {}, control); });
  expect_mistake("no shape", [&] { choose_tuples(field, {}, flat, {}, control); });
  expect_mistake("no field", [&] { choose_tuples({}, shape, flat, {}, control); });
  expect_mistake("tolerance", [&] { choose_tuples(field, shape, flat, {-1, 2}, control); });
  for (const int band : {-1, 2}) {
    expect_mistake("band", [&] { encode_tuples(shape, band, {}); });
    expect_mistake("band", [&] { decode_tuples(shape, band, "", 1e6); });
  }
}

TEST(MistakesOfSparse, PicturesThatDoNotBelongTogether) {
  const Image<std::uint16_t> picture(7, 5, 3), other(5, 7, 3), grey(7, 5, 1);
  expect_mistake("size", [&] { encode_difference(picture, other, 8, 0); });
  expect_mistake("channels", [&] { encode_difference(grey, grey, 8, 0); });
  expect_mistake("channels", [&] { decode_difference("", grey, 8); });
  expect_mistake("bits", [&] { encode_difference(picture, picture, 40, 0); });
  expect_mistake("bits", [&] { decode_difference("", picture, 0); });
  expect_mistake("error", [&] { encode_difference(picture, picture, 8, -1); });
  expect_mistake("bytes", [&] { decode_difference("nonsense", picture, 8); });
  expect_mistake("bytes", [] { decompressed("nonsense", 100); });
}

}  // namespace
}  // namespace gigaray
