// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/kept_pictures.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "gigaray/core/parallel.h"
#include "support/counting_pixels.h"

namespace gigaray::testing_support {
namespace {

constexpr double kGiB = 1 << 30;

Image<std::uint16_t> picture(int width, int height, int channels, unsigned most, unsigned seed) {
  Image<std::uint16_t> image(width, height, channels);
  for (std::size_t i = 0; i < image.size(); ++i)
    image.data()[i] = std::uint16_t((i * 2654435761u + seed * 40503u) % (most + 1));
  return image;
}

/// Views on a line that have to be decoded, as far as anybody can tell.
struct Decoded {
  LightField light_field;
  std::shared_ptr<CountingPixels> reads;
  std::vector<Image<std::uint16_t>> pictures;

  explicit Decoded(int num_views, int bit_depth = 8, int channels = 3) {
    light_field.width = 50;
    light_field.height = 31;
    for (int i = 0; i < num_views; ++i) {
      light_field.views.push_back({"view" + std::to_string(i), double(i), 0});
      pictures.push_back(picture(50, 31, channels, (1u << bit_depth) - 1, unsigned(i)));
    }
    light_field.pixels = pixels_in_memory(pictures, bit_depth);
    reads = count_reads(light_field);
  }
};

TEST(KeptPictures, APictureIsReadOnceAndComesBackTheSame) {
  for (const int bit_depth : {8, 16})
    for (const int channels : {3, 4}) {
      const Decoded field(3, bit_depth, channels);
      const auto kept = std::make_shared<KeptPictures>(kGiB);
      const LightField over = KeptPictures::over(kept, field.light_field);
      for (int again = 0; again < 3; ++again)
        for (const int view : {0, 2}) EXPECT_EQ(over.pixels->read(view), field.pictures[view]);
      EXPECT_EQ(field.reads->count(0), 1);
      EXPECT_EQ(field.reads->count(1), 0);
      EXPECT_EQ(field.reads->count(2), 1);
      EXPECT_EQ(kept->num_decoded(), 2);
      EXPECT_EQ(kept->bytes(), 2.0 * 50 * 31 * channels * bit_depth / 8);
    }
}

TEST(KeptPictures, WhatIsLetGoIsFreed) {
  const Decoded field(3);
  const auto kept = std::make_shared<KeptPictures>(kGiB);
  const LightField over = KeptPictures::over(kept, field.light_field);
  for (int view = 0; view < 3; ++view) over.pixels->read(view);
  over.pixels->let_go(1);
  over.pixels->let_go(1);
  EXPECT_EQ(kept->bytes(), 2.0 * 50 * 31 * 3);
  const LightField rest = without(over, {0});
  EXPECT_EQ(kept->bytes(), 1.0 * 50 * 31 * 3) << "nobody looks at what is left out";
  EXPECT_EQ(rest.pixels->read(0), field.pictures[1]);
  EXPECT_EQ(field.reads->count(1), 2);
  rest.pixels->let_go(1);
  rest.pixels->let_go(0);
  EXPECT_EQ(kept->bytes(), 0);
}

TEST(KeptPictures, WhatThereIsNoRoomForIsReadAgain) {
  const Decoded field(4);
  // A third of what is left beside the program is the room: of two pictures and a half.
  const double pictures = 2.5 * 50 * 31 * 3;
  const auto kept = std::make_shared<KeptPictures>(224 * double(1 << 20) + 3 * pictures);
  const LightField over = KeptPictures::over(kept, field.light_field);
  for (int again = 0; again < 2; ++again)
    for (int view = 0; view < 4; ++view) EXPECT_EQ(over.pixels->read(view), field.pictures[view]);
  EXPECT_LE(kept->bytes(), pictures);
  EXPECT_EQ(field.reads->total(), 6);
  const auto none = std::make_shared<KeptPictures>(1.0);
  const LightField tight = KeptPictures::over(none, field.light_field);
  EXPECT_EQ(tight.pixels->read(1), field.pictures[1]);
  EXPECT_EQ(none->bytes(), 0);
}

TEST(KeptPictures, SourcesShareWhatHasTheSameKey) {
  const Decoded field(3);
  const auto kept = std::make_shared<KeptPictures>(kGiB);
  const auto first = KeptPictures::over(kept, field.light_field.pixels, {"a", "b", "c"});
  const auto second = KeptPictures::over(kept, field.light_field.pixels, {"a", "x", "c"});
  for (int view = 0; view < 3; ++view) EXPECT_EQ(first->read(view), second->read(view));
  EXPECT_EQ(field.reads->total(), 4);
  // Keys that are not stated are those of one source alone.
  KeptPictures::over(kept, field.light_field).pixels->read(0);
  KeptPictures::over(kept, field.light_field).pixels->read(0);
  EXPECT_EQ(field.reads->total(), 6);
}

TEST(KeptPictures, WhatIsInMemoryAnywayIsNotKeptTwice) {
  const Decoded field(2);
  const auto kept = std::make_shared<KeptPictures>(kGiB), other = std::make_shared<KeptPictures>();
  const LightField once = KeptPictures::over(kept, field.light_field);
  EXPECT_EQ(KeptPictures::over(other, once).pixels, once.pixels);
  EXPECT_EQ(KeptPictures::over(nullptr, field.light_field).pixels, field.light_field.pixels);
  const auto in_memory = pixels_in_memory(field.pictures, 8);
  EXPECT_EQ(KeptPictures::over(kept, in_memory, {"a", "b"}), in_memory);
}

TEST(KeptPictures, ManyThreadsMayRead) {
  const Decoded field(20);
  const auto kept = std::make_shared<KeptPictures>(kGiB);
  const LightField over = KeptPictures::over(kept, field.light_field);
  set_num_threads(4);
  parallel_for(
      200,
      [&](int i) {
        EXPECT_EQ(over.pixels->read(i % 20), field.pictures[i % 20]);
        if (i % 7 == 0) over.pixels->let_go(i % 20);
      },
      [](int) {});
  set_num_threads(0);
  for (int view = 0; view < 20; ++view) over.pixels->let_go(view);
  EXPECT_EQ(kept->bytes(), 0);
}

}  // namespace
}  // namespace gigaray::testing_support
