// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gigaray {
namespace {

TEST(Smoothing, KeepsAConstantAndSpreadsAPointAsAGaussian) {
  Image<std::uint16_t> picture(31, 25, 3, 1000);
  EXPECT_EQ(smooth_picture(picture, 0.8), picture);
  for (int c = 0; c < 3; ++c) picture(15, 12, c) = 61000;
  const Image<std::uint16_t> smooth = smooth_picture(picture, 1.0);
  const double peak = 60000 / (2 * 3.14159265);
  EXPECT_NEAR(smooth(15, 12, 1), 1000 + peak, 0.02 * peak);
  EXPECT_NEAR(smooth(17, 12, 2), 1000 + peak * std::exp(-2.0), 0.02 * peak);
  EXPECT_EQ(smooth(17, 12), smooth(15, 14));
  EXPECT_EQ(smooth(5, 12), 1000);
}

TEST(Smoothing, EdgesAreRepeated) {
  Image<std::uint16_t> picture(9, 7, 1, 0);
  for (int v = 0; v < 7; ++v) picture(0, v) = 100;
  const Image<std::uint16_t> smooth = smooth_picture(picture, 0.7);
  for (int v = 0; v < 7; ++v) EXPECT_EQ(smooth(0, v), smooth(0, 3));
  EXPECT_GT(smooth(0, 0), 70) << "half of the Gaussian lies beyond the edge";
}

TEST(Smoothing, OfALightFieldSmoothsEveryViewAsItIsRead) {
  Image<std::uint16_t> picture(11, 9, 3, 0);
  picture(5, 4, 0) = 200;
  LightField field;
  field.width = 11;
  field.height = 9;
  field.views = {{"a", 0, 0}, {"b", 1, 0}};
  field.pixels = pixels_in_memory({picture, Image<std::uint16_t>(11, 9, 3, 7)}, 8);
  const LightField smooth = smoothed(field, 1);
  EXPECT_EQ(smooth.pixels->bit_depth(), 8);
  EXPECT_EQ(smooth.pixels->read(0), smooth_picture(picture, 1));
  EXPECT_EQ(smooth.pixels->read(1)(3, 3, 1), 7);
  EXPECT_EQ(field.pixels->read(0), picture) << "the original stays";
}

}  // namespace
}  // namespace gigaray
