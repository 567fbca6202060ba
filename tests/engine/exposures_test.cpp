// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/exposures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

/// What the pictures of a light field would be under other exposures.
class ExposedPixels : public PixelSource {
 public:
  ExposedPixels(std::shared_ptr<const PixelSource> pixels, std::vector<Exposure> exposures)
      : pixels_(std::move(pixels)), exposures_(std::move(exposures)) {}
  Image<std::uint16_t> read(int view_idx) const override {
    Image<std::uint16_t> picture = pixels_->read(view_idx);
    for (int v = 0; v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u)
        for (int c = 0; c < 3; ++c)
          picture(u, v, c) = std::uint16_t(std::min<long>(
              std::lround(picture(u, v, c) * std::exp(exposures_[view_idx][c])), 255));
    return picture;
  }
  int bit_depth() const override { return 8; }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  std::vector<Exposure> exposures_;
};

class Exposures : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<View> grid = grid_of_views(3, 3);
    field_ = posed_field(cameras_around(grid, 151, 115), grid);
    for (Camera& camera : field_.light_field.cameras)
      camera.inverse_depth = InverseDepthRange{1 / 12.0, 1 / 7.5};
  }
  PosedField field_;
};

TEST_F(Exposures, AlikeAreLeftAlone) {
  const auto found = estimate_exposures(field_.light_field, RunControl());
  ASSERT_EQ(int(found.size()), field_.light_field.num_views());
  EXPECT_FALSE(differ(found));
}

TEST_F(Exposures, AreFoundByChannelAndTakenOut) {
  const LightField original = field_.light_field;
  std::vector<Exposure> exact(std::size_t(original.num_views()));
  Exposure brightest{-1, -1, -1};
  for (std::size_t i = 0; i < exact.size(); ++i) {
    exact[i] = {0.1f * std::sin(float(3 * i)), -0.15f * std::cos(float(2 * i)), 0.05f};
    for (int c = 0; c < 3; ++c) brightest[c] = std::max(brightest[c], exact[i][c]);
  }
  LightField exposed = original;
  exposed.pixels = std::make_shared<ExposedPixels>(original.pixels, exact);
  const auto found = estimate_exposures(exposed, RunControl());
  EXPECT_TRUE(differ(found));
  for (std::size_t i = 0; i < exact.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[i][c], exact[i][c] - brightest[c], 0.02) << i;

  // As bright as the brightest.
  const auto even = evened(exposed, found).pixels->read(1), was = original.pixels->read(1);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(even(20, 15, c), was(20, 15, c) * std::exp(brightest[c]), 4) << c;
}

TEST_F(Exposures, WhatIsClippedStaysAsItIs) {
  const int views = field_.light_field.num_views();
  const LightField dark =
      evened(field_.light_field, std::vector<Exposure>(views, {0.5f, 0.5f, 0.5f}));
  LightField white = field_.light_field;
  white.pixels = std::make_shared<ExposedPixels>(white.pixels,
                                                 std::vector<Exposure>(views, {9.0f, 9.0f, 9.0f}));
  white = evened(white, std::vector<Exposure>(views, {0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(white.pixels->read(0)(10, 10, 0), 255);
  EXPECT_NEAR(dark.pixels->read(0)(10, 10, 0),
              field_.light_field.pixels->read(0)(10, 10, 0) * std::exp(-0.5), 0.51);
}

TEST_F(Exposures, OfAViewThatMatchesNoneAreTheUsualOnes) {
  LightField stray = field_.light_field;
  class OneFlat : public PixelSource {
   public:
    explicit OneFlat(std::shared_ptr<const PixelSource> pixels) : pixels_(std::move(pixels)) {}
    Image<std::uint16_t> read(int view_idx) const override {
      Image<std::uint16_t> picture = pixels_->read(view_idx);
      if (view_idx == 2)
        for (std::uint16_t& value : picture) value = 40;
      return picture;
    }
    int bit_depth() const override { return 8; }

   private:
    std::shared_ptr<const PixelSource> pixels_;
  };
  stray.pixels = std::make_shared<OneFlat>(stray.pixels);
  const auto found = estimate_exposures(stray, RunControl());
  EXPECT_FALSE(differ(found));
  EXPECT_NEAR(found[2][0], found[3][0], 0.03);
}

}  // namespace
}  // namespace gigaray::testing_support
