// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/sparse/sparse_coding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <tuple>

#include "src/range_coder.h"
#include "support/errors.h"

namespace gigaray {
namespace {

constexpr double kEnough = 1 << 30;  // bytes

using testing_support::expect_error;

using Picture = Image<std::uint16_t>;

/// Any values, or a ramp with some noise.
Picture picture_of(int width, int height, int bit_depth, int noise, unsigned seed) {
  std::mt19937 random(seed);
  Picture picture(width, height, 3);
  const int most = (1 << bit_depth) - 1;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      for (int c = 0; c < 3; ++c)
        picture(u, v, c) = std::uint16_t(std::clamp<int>(
            most / 3 + (u + 2 * v) * most / 600 + int(random() % (2 * noise + 1)) - noise, 0,
            most));
  return picture;
}

TEST(DifferenceCoding, RestoresEveryPictureFromAnyDrawing) {
  struct Case {
    int width, height, bit_depth, noise;
  };
  for (const Case& c : {Case{1, 1, 8, 3},
                        {7, 1, 8, 255},
                        {1, 9, 8, 2},
                        {93, 47, 8, 0},
                        {93, 47, 8, 4},
                        {64, 33, 8, 255},
                        {31, 17, 16, 65535},
                        {93, 47, 16, 900}}) {
    const Picture picture = picture_of(c.width, c.height, c.bit_depth, c.noise, 1);
    const Picture alike = picture_of(c.width, c.height, c.bit_depth, c.noise, 2);
    const Picture black(c.width, c.height, 3);
    for (const Picture* drawn : {&picture, &alike, &black}) {
      const std::string bytes = encode_difference(picture, *drawn, c.bit_depth, 0);
      EXPECT_TRUE(decode_difference(bytes, *drawn, c.bit_depth) == picture)
          << c.width << " x " << c.height << ", " << c.bit_depth << " bit, noise " << c.noise;
    }
  }
}

TEST(DifferenceCoding, LossyKeepsTheBound) {
  const Picture picture = picture_of(93, 47, 8, 9, 1);
  const Picture drawn = picture_of(93, 47, 8, 2, 2);
  std::size_t last_size = encode_difference(picture, drawn, 8, 0).size();
  for (const int bound : {1, 2, 5, 100}) {
    const std::string bytes = encode_difference(picture, drawn, 8, bound);
    const Picture decoded = decode_difference(bytes, drawn, 8);
    int worst = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
      worst = std::max(worst, std::abs(picture.data()[i] - decoded.data()[i]));
    EXPECT_LE(worst, bound);
    EXPECT_GT(worst, 0) << bound;
    EXPECT_LT(bytes.size(), last_size) << bound;
    last_size = bytes.size();
  }
}

TEST(DifferenceCoding, AGoodDrawingMakesItSmall) {
  const Picture picture = picture_of(93, 47, 8, 20, 1);
  Picture drawn = picture;
  drawn(5, 5, 0) = std::uint16_t(drawn(5, 5, 0) + 7);
  const Picture black(93, 47, 3);
  EXPECT_LT(encode_difference(picture, drawn, 8, 0).size() * 4,
            encode_difference(picture, black, 8, 0).size());
}

TEST(DifferenceCoding, DamagedBytesEndInAnErrorOrAPicture) {
  const Picture picture = picture_of(31, 17, 8, 3, 1);
  const Picture drawn = picture_of(31, 17, 8, 3, 2);
  const std::string bytes = encode_difference(picture, drawn, 8, 0);
  int refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const int bit : {0, 7}) {
      std::string damaged = bytes;
      damaged[i] = char(damaged[i] ^ (1 << bit));
      try {
        decode_difference(damaged, drawn, 8);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kBadInput);
        ++refused;
      }
    }
  EXPECT_GT(refused, 0);
  for (const std::size_t size :
       {std::size_t(0), std::size_t(1), bytes.size() / 2, bytes.size() - 1})
    expect_error(ErrorCode::kBadInput, {"is damaged"},
                 [&] { decode_difference(bytes.substr(0, size), drawn, 8); });
}

SparseShape small_shape() {
  SparseShape shape;
  shape.width = 97;
  shape.height = 50;
  shape.band_rows = 20;
  shape.slope_bits = 8;
  shape.positions.resize(9);
  return shape;
}

TupleBand any_tuples(const SparseShape& shape, int band, int count) {
  std::mt19937 random(7);
  const RowRange rows = shape.band(band);
  TupleBand tuples;
  for (int i = 0; i < count; ++i) {
    SparseTuple tuple;
    tuple.slope = int(random() % 300) - 150;
    tuple.view = int(random() % shape.positions.size());
    tuple.u = int(random() % unsigned(shape.width));
    tuple.v = rows.begin + int(random() % unsigned(rows.size()));
    for (std::uint16_t& value : tuple.colour) value = std::uint16_t(random() % 256);
    tuples.tuples.push_back(tuple);
    tuples.least_slope = std::min(tuples.least_slope, tuple.slope);
    tuples.largest_slope = std::max(tuples.largest_slope, tuple.slope);
  }
  std::sort(tuples.tuples.begin(), tuples.tuples.end(),
            [](const SparseTuple& a, const SparseTuple& b) {
              return std::tie(a.slope, a.view, a.v, a.u) < std::tie(b.slope, b.view, b.v, b.u);
            });
  return tuples;
}

TEST(TupleCoding, RestoresTheTuples) {
  const SparseShape shape = small_shape();
  for (const int band : {0, 1, 2})
    for (const int count : {0, 1, 3000}) {
      const TupleBand tuples = any_tuples(shape, band, count);
      const TupleBand decoded =
          decode_tuples(shape, band, encode_tuples(shape, band, tuples), kEnough);
      EXPECT_TRUE(decoded.tuples == tuples.tuples) << band << ", " << count;
      EXPECT_EQ(decoded.least_slope, tuples.least_slope);
      EXPECT_EQ(decoded.largest_slope, tuples.largest_slope);
    }
}

TEST(TupleCoding, DamagedBytesAreRefusedOrStayInsideTheLightField) {
  const SparseShape shape = small_shape();
  const std::string bytes = encode_tuples(shape, 1, any_tuples(shape, 1, 200));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = char(damaged[i] ^ 0x10);
    try {
      for (const SparseTuple& tuple : decode_tuples(shape, 1, damaged, kEnough).tuples) {
        ASSERT_TRUE(tuple.u >= 0 && tuple.u < shape.width && tuple.v >= 20 && tuple.v < 40);
        ASSERT_TRUE(tuple.view >= 0 && tuple.view < 9);
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    }
  }
  expect_error(ErrorCode::kBadInput, {"is damaged"},
               [&] { decode_tuples(shape, 1, bytes.substr(0, bytes.size() - 3), kEnough); });
}

TEST(Compressed, RestoresAnyBytesAndRefusesMoreThanItMay) {
  const std::string bytes(1000, 'x');
  EXPECT_EQ(decompressed(compressed(bytes), 1000), bytes);
  EXPECT_EQ(decompressed(compressed(""), 0), "");
  expect_error(ErrorCode::kBadInput, {"too large"}, [&] { decompressed(compressed(bytes), 999); });
}

TEST(RangeCoder, RestoresNumbersOfAnySize) {
  std::mt19937 random(3);
  std::vector<std::uint32_t> numbers{0, 1, 19, 20, 21, 255, 70000, 131071};
  for (int i = 0; i < 20000; ++i)
    numbers.push_back(random() % 100 < 97 ? random() % 3 : random() % 3000);
  for (const int low_bits : {0, 1, 5, 12}) {
    RangeEncoder encoder;
    NumberModel written;
    for (const std::uint32_t number : numbers) written.put(number, low_bits, encoder);
    const std::string bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    NumberModel read;
    for (const std::uint32_t number : numbers) ASSERT_EQ(read.get(low_bits, decoder), number);
    EXPECT_TRUE(decoder.at_end());
  }
}

TEST(RangeCoder, ComesNearTheEntropy) {
  std::mt19937 random(5);
  RangeEncoder encoder;
  BitModel model;
  constexpr int kBits = 100000;
  for (int i = 0; i < kBits; ++i) encoder.put(random() % 100 < 5, model);
  const double entropy = -(0.05 * std::log2(0.05) + 0.95 * std::log2(0.95)) * kBits / 8;
  // Learning from the last bits costs some percent.
  EXPECT_LT(double(encoder.finish().size()), 1.06 * entropy);
}

}  // namespace
}  // namespace gigaray
