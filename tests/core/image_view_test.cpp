// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/image_view.h"

#include <gtest/gtest.h>

#include <memory>

namespace gigaray {
namespace {

TEST(ImageView, ReadsPaddedRowsOfBytes) {
  // Two rows of two RGB pixels, with two bytes of padding each.
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6, 0, 0, 7, 8, 9, 10, 11, 12, 0, 0};
  const ImageView<const std::uint8_t> view(bytes.data(), 2, 2, 3, 8);
  const auto pixels = pixels_of_views(std::vector{view});
  EXPECT_EQ(pixels->bit_depth(), 8);
  EXPECT_EQ(pixels->read(0),
            Image<std::uint16_t>(2, 2, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST(ImageView, ReadsBgrUpsideDown) {
  const std::vector<std::uint16_t> words{1, 2, 3, 4, 5, 6};  // a column of two BGR pixels
  ImageView<const std::uint16_t> view(words.data(), 1, 2, 3);
  view.data += 5;  // red of the last row
  view.stride_v = -view.stride_v;
  view.stride_c = -view.stride_c;
  const auto pixels = pixels_of_views(std::vector{view});
  EXPECT_EQ(pixels->bit_depth(), 16);
  EXPECT_EQ(pixels->read(0), Image<std::uint16_t>(1, 2, 3, {6, 5, 4, 3, 2, 1}));
}

TEST(ImageView, RepeatsGreyAndDropsAFourthChannel) {
  const std::vector<std::uint8_t> grey{7, 9}, rgba{1, 2, 3, 255, 4, 5, 6, 0};
  const auto of_grey =
      pixels_of_views(std::vector{ImageView<const std::uint8_t>(grey.data(), 2, 1, 1)});
  EXPECT_EQ(of_grey->read(0), Image<std::uint16_t>(2, 1, 3, {7, 7, 7, 9, 9, 9}));
  const auto of_rgba =
      pixels_of_views(std::vector{ImageView<const std::uint8_t>(rgba.data(), 2, 1, 4)});
  EXPECT_EQ(of_rgba->read(0), Image<std::uint16_t>(2, 1, 3, {1, 2, 3, 4, 5, 6}));
}

TEST(ImageView, KeepsTheOwner) {
  auto owner = std::make_shared<std::vector<std::uint8_t>>(3, std::uint8_t(5));
  const std::weak_ptr<const void> there = owner;
  const std::vector pictures{ImageView<const std::uint8_t>(owner->data(), 1, 1, 3)};
  auto pixels = pixels_of_views(pictures, std::move(owner));
  EXPECT_FALSE(there.expired());
  EXPECT_EQ(pixels->read(0)(0, 0, 2), 5);
  pixels.reset();
  EXPECT_TRUE(there.expired());
}

TEST(ImageView, RefusesWhatCannotBePictures) {
  const std::vector<std::uint8_t> bytes(24);
  using View = ImageView<const std::uint8_t>;
  EXPECT_THROW(pixels_of_views(std::vector{View()}), Error);
  EXPECT_THROW(pixels_of_views(std::vector{View(bytes.data(), 0, 1, 3)}), Error);
  EXPECT_THROW(pixels_of_views(std::vector{View(bytes.data(), 2, 2, 2)}), Error);
  EXPECT_THROW(
      pixels_of_views(std::vector{View(bytes.data(), 2, 2, 3), View(bytes.data(), 2, 1, 3)}),
      Error);
  EXPECT_THROW(pixels_of_views(std::vector{View(bytes.data(), 2, 2, 3)})->read(1), Error);
}

}  // namespace
}  // namespace gigaray
