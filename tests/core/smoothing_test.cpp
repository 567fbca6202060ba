// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/smoothing.h"

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

TEST(Halving, TakesEverySecondPixelOfSmoothPicturesAndTheCamerasFollow) {
  Image<std::uint16_t> picture(11, 8, 4);
  for (int v = 0; v < 8; ++v)
    for (int u = 0; u < 11; ++u) {
      for (int c = 0; c < 3; ++c) picture(u, v, c) = std::uint16_t(20 * u + 3 * v + c);
      picture(u, v, 3) = u < 6 ? 255 : 0;
    }
  class Masked : public PixelSource {
   public:
    explicit Masked(Image<std::uint16_t> picture) : picture_(std::move(picture)) {}
    Image<std::uint16_t> read(int) const override { return picture_; }
    int bit_depth() const override { return 8; }
    bool has_mask() const override { return true; }
    void let_go(int) const override { FAIL() << "somebody reads it once more"; }

   private:
    Image<std::uint16_t> picture_;
  };
  LightField field;
  field.kind = LightFieldKind::kUnstructured;
  field.width = 11;
  field.height = 8;
  field.views = {{"a", 0, 0}, {"b", 1, 0}};
  Camera camera;
  camera.width = 11;
  camera.height = 8;
  camera.focal_u = 12;
  camera.focal_v = 13;
  camera.centre_u = 5;
  camera.centre_v = 3.5;
  field.cameras = {camera, camera};
  field.pixels = std::make_shared<Masked>(picture);
  const LightField half = halved(field);
  EXPECT_EQ(half.width, 6);
  EXPECT_EQ(half.height, 4);
  const Image<std::uint16_t> smooth = smooth_picture(picture, std::sqrt(0.5));
  const Image<std::uint16_t> small = half.pixels->read(1);
  half.pixels->let_go(1);
  ASSERT_EQ(small.width(), 6);
  ASSERT_EQ(small.height(), 4);
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 6; ++u) {
      for (int c = 0; c < 3; ++c) EXPECT_EQ(small(u, v, c), smooth(2 * u, 2 * v, c));
      EXPECT_EQ(small(u, v, 3), picture(2 * u, 2 * v, 3));
    }
  // A point that is seen at a pixel of the half is seen there in the whole.
  const Camera& scaled = half.cameras[1];
  EXPECT_EQ(scaled.width, 6);
  const Eigen::Vector3d point = scaled.back_project(4, 3, 2);
  EXPECT_NEAR(camera.project(point).x(), 8, 1e-12);
  EXPECT_NEAR(camera.project(point).y(), 6, 1e-12);
}

TEST(Halving, IsForPosedCameras) {
  LightField field;
  field.kind = LightFieldKind::k4D;
  EXPECT_THROW(halved(field), Error);
}

}  // namespace
}  // namespace gigaray
