// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/posed_pictures.h"

#include <cmath>
#include <thread>

#include "adapters/adapters_test.h"
#include "support/analytic_field.h"

namespace gigaray {
namespace {

using Eigen::Vector2d;
using testing_support::WavePattern;

constexpr int kWide = 143, kHigh = 93;

class PosedPictures : public AdaptersTest {
 protected:
  /// What a pinhole camera with the lens's focal length and principal point sees of a far wall.
  static double wall(double u, double v, int c) {
    static const WavePattern pattern(5, 0.8);
    return pattern(u, v, c);
  }

  /// The wall as the lens shows it; black where the lens shows nothing.
  static cv::Mat seen_through(const Lens& lens, int bit_depth = 8) {
    const LensMap map(lens);
    cv::Mat mat = cv::Mat::zeros(lens.height, lens.width, bit_depth == 8 ? CV_8UC3 : CV_16UC3);
    for (int v = 0; v < lens.height; ++v)
      for (int u = 0; u < lens.width; ++u)
        if (const auto direction = map.undistort({u, v})) {
          const Vector2d at = direction->cwiseProduct(map.focal()) + map.centre();
          for (int c = 0; c < 3; ++c) {
            const double value = wall(at.x(), at.y(), c);
            if (bit_depth == 8)
              mat.at<cv::Vec3b>(v, u)[2 - c] = std::uint8_t(std::lround(255 * value));
            else
              mat.at<cv::Vec3w>(v, u)[2 - c] = std::uint16_t(std::lround(65535 * value));
          }
        }
    return mat;
  }

  PosedPicture posed(const std::string& name, const Lens& lens, double right = 0) const {
    PosedPicture one;
    one.file = folder / (name + ".png");
    one.name = name;
    one.lens = lens;
    one.translation = {-right, 0, 0};
    return one;
  }

  /// Two views through the lens, one step apart.
  LightField two_views(const Lens& lens, const cv::Mat& picture) const {
    save("a.png", picture);
    save("b.png", picture);
    return posed_light_field({posed("a", lens), posed("b", lens, 1)}, "test");
  }

  static void expect_wall(const Image<std::uint16_t>& picture, int most, double tolerance) {
    double worst = 0;
    int valid = 0;
    for (int v = 0; v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u) {
        if (picture.channels() == 4 && picture(u, v, 3) == 0) continue;
        ++valid;
        // Half a pixel from the border of the source is extrapolated.
        if (u < 2 || v < 2 || u >= picture.width() - 2 || v >= picture.height() - 2) continue;
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(picture(u, v, c) / double(most) - wall(u, v, c)));
      }
    EXPECT_LT(worst, tolerance);
    EXPECT_GT(valid, picture.width() * picture.height() / 2);
  }

  const Lens pinhole{"PINHOLE", kWidth, kHeight, {30, 31, 11.5, 8.5}};
  const Lens barrel{"OPENCV", kWide, kHigh, {120, 121, 72, 46, -0.2, 0.05, 0.002, -0.001}};
  const Lens cushion{"SIMPLE_RADIAL", kWide, kHigh, {120, 71.5, 46.5, 0.15}};
  const Lens fisheye{"OPENCV_FISHEYE", kWide, kHigh, {95, 95, 72, 46, 0.03, -0.01, 0, 0}};
};

// Bicubic at 1/32 px of waves of 7 px and more, and 8-bit rounding twice.
constexpr double kResampled = 0.03;

TEST_F(PosedPictures, PinholeIsNotTouched) {
  const LightField light_field = two_views(pinhole, picture());
  EXPECT_EQ(light_field.kind, LightFieldKind::kUnstructured);
  EXPECT_EQ(light_field.format, "test");
  EXPECT_TRUE(light_field.notes.empty());
  EXPECT_FALSE(light_field.pixels->has_mask());
  const auto read = read_view(light_field, 1);
  ASSERT_EQ(read.channels(), 3);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(read(u, v, c), picture().at<cv::Vec3b>(v, u)[2 - c]) << u << " " << v;
}

TEST_F(PosedPictures, CameraHasPixelCentresAtIntegersAndThePose) {
  const LightField light_field = two_views(pinhole, picture());
  const Camera& camera = light_field.cameras.at(1);
  EXPECT_EQ(camera.width, kWidth);
  EXPECT_EQ(camera.height, kHeight);
  EXPECT_DOUBLE_EQ(camera.focal_u, 30);
  EXPECT_DOUBLE_EQ(camera.focal_v, 31);
  EXPECT_DOUBLE_EQ(camera.centre_u, 11);
  EXPECT_DOUBLE_EQ(camera.centre_v, 8);
  EXPECT_DOUBLE_EQ(camera.position().x(), 1);
  EXPECT_NEAR(std::abs(light_field.views[1].s - light_field.views[0].s), 1, 1e-12);
  EXPECT_FALSE(light_field.rig.baseline.has_value());
  EXPECT_NO_THROW(check(light_field));
}

TEST_F(PosedPictures, EveryLensBecomesThePinholeOfTheSameFocalLength) {
  for (const Lens& lens : {barrel, cushion, fisheye})
    for (const int bit_depth : {8, 16}) {
      SCOPED_TRACE(lens.model + " " + std::to_string(bit_depth));
      const LightField light_field = two_views(lens, seen_through(lens, bit_depth));
      EXPECT_EQ(light_field.pixels->bit_depth(), bit_depth);
      expect_wall(read_view(light_field, 0), (1 << bit_depth) - 1, kResampled);
      ASSERT_EQ(light_field.notes.size(), 1);
      EXPECT_NE(light_field.notes[0].find(lens.model), std::string::npos);
    }
}

TEST_F(PosedPictures, WhatTheLensDidNotSeeIsMaskedAndBlack) {
  const LightField light_field = two_views(cushion, seen_through(cushion));
  ASSERT_TRUE(light_field.pixels->has_mask());
  const auto read = read_view(light_field, 0);
  for (int v = 0; v < kHigh; ++v)
    for (int u = 0; u < kWide; ++u) {
      const auto source = distort(cushion, {(u - 71.0) / 120, (v - 46.0) / 120});
      const bool inside = source && source->x() >= -0.5 && source->y() >= -0.5 &&
                          source->x() <= kWide - 0.5 && source->y() <= kHigh - 0.5;
      ASSERT_EQ(read(u, v, 3), inside ? 255 : 0) << u << " " << v;
      if (inside) continue;
      ASSERT_EQ(read(u, v, 0) + read(u, v, 1) + read(u, v, 2), 0);
    }
  EXPECT_EQ(read(0, 0, 3), 0);
}

TEST_F(PosedPictures, BarrelDistortionFillsThePictureAndNeedsNoMask) {
  const LightField light_field = two_views(barrel, seen_through(barrel));
  EXPECT_FALSE(light_field.pixels->has_mask());
  EXPECT_EQ(read_view(light_field, 0).channels(), 3);
}

TEST_F(PosedPictures, SmallerOnesArePaddedAtRightAndBottom) {
  save("a.png", picture(CV_8UC3, kWidth, kHeight));
  save("b.png", picture(CV_8UC3, 19, 21));
  const Lens other{"PINHOLE", 19, 21, {30, 31, 9.5, 10.5}};
  const LightField light_field =
      posed_light_field({posed("a", pinhole), posed("b", other, 2)}, "x");
  EXPECT_EQ(light_field.width, kWidth);
  EXPECT_EQ(light_field.height, 21);
  EXPECT_EQ(light_field.cameras[1].width, 19);
  EXPECT_EQ(light_field.cameras[0].height, kHeight);
  const auto read = read_view(light_field, 1);
  for (int v = 0; v < read.height(); ++v)
    for (int u = 0; u < read.width(); ++u) ASSERT_EQ(read(u, v, 3), u < 19 ? 255 : 0);
  EXPECT_EQ(read_view(light_field, 0)(0, kHeight, 3), 0);
  EXPECT_EQ(read_view(light_field, 0)(kWidth - 1, kHeight - 1, 3), 255);
  EXPECT_NO_THROW(check(light_field));
}

TEST_F(PosedPictures, BlackOfAMaskIsLeftOut) {
  save("a.png");
  save("b.png");
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  mask.at<std::uint8_t>(3, 5) = 0;
  mask.at<std::uint8_t>(4, 5) = 1;
  save("mask.png", mask);
  PosedPicture masked = posed("b", pinhole, 1);
  masked.mask = folder / "mask.png";
  const LightField light_field = posed_light_field({posed("a", pinhole), masked}, "x");
  const auto read = read_view(light_field, 1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(read(u, v, 3), u == 5 && v == 3 ? 0 : 255);
  EXPECT_EQ(read_view(light_field, 0)(5, 3, 3), 255);
}

TEST_F(PosedPictures, TransparentPixelsAreMasked) {
  for (const int type : {CV_8UC4, CV_16UC4}) {
    const int most = type == CV_8UC4 ? 255 : 65535;
    cv::Mat mat = picture(type);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const int alpha = u < 4 ? 0 : u < 6 ? most / 3 : u < 8 ? 2 * most / 3 : most;
        if (type == CV_8UC4)
          mat.at<cv::Vec4b>(v, u)[3] = std::uint8_t(alpha);
        else
          mat.at<cv::Vec4w>(v, u)[3] = std::uint16_t(alpha);
      }
    const LightField light_field = two_views(pinhole, mat);
    EXPECT_NE(light_field.notes.at(0).find("alpha channel of 2 of 2 pictures"), std::string::npos);
    EXPECT_EQ(light_field.notes.size(), 1u);
    const auto read = read_view(light_field, 1);
    ASSERT_EQ(read.channels(), 4);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) EXPECT_EQ(read(u, v, 3), u < 6 ? 0 : most) << u;
    // A mask leaves out more.
    cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
    mask.col(20) = 0;
    save("mask.png", mask);
    PosedPicture masked = posed("a", pinhole);
    masked.mask = folder / "mask.png";
    const auto both = read_view(posed_light_field({masked, posed("b", pinhole, 1)}, "test"), 0);
    EXPECT_EQ(both(5, 3, 3), 0);
    EXPECT_EQ(both(20, 3, 3), 0);
    EXPECT_EQ(both(19, 3, 3), most);
  }
}

TEST_F(PosedPictures, WhatIsTransparentEverywhereIsNotMasked) {
  cv::Mat mat = picture(CV_8UC4);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) mat.at<cv::Vec4b>(v, u)[3] = 0;
  const auto read = read_view(two_views(pinhole, mat), 0);
  for (int v = 0; v < kHeight; ++v) EXPECT_EQ(read(7, v, 3), 255);
}

TEST_F(PosedPictures, MaskIsUndistortedWithItsPicture) {
  save("a.png", seen_through(barrel));
  save("b.png", seen_through(barrel));
  cv::Mat mask(kHigh, kWide, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(0, 0, 40, kHigh)) = 0;
  save("mask.png", mask);
  PosedPicture masked = posed("b", barrel, 1);
  masked.mask = folder / "mask.png";
  const auto read = read_view(posed_light_field({posed("a", barrel), masked}, "x"), 1);
  for (int v = 0; v < kHigh; ++v)
    for (int u = 0; u < kWide; ++u) {
      const double x = distort(barrel, {(u - 71.5) / 120, (v - 45.5) / 121}).value().x();
      if (std::abs(x - 39.5) < 0.1) continue;
      ASSERT_EQ(read(u, v, 3), x > 39.5 ? 255 : 0) << u << " " << v;
    }
}

TEST_F(PosedPictures, LensIsScaledToThePicture) {
  Lens large = barrel;
  large.width *= 4;
  large.height *= 4;
  for (int i = 0; i < 4; ++i) large.params[i] *= 4;
  const LightField light_field = two_views(large, seen_through(barrel));
  EXPECT_NEAR(light_field.cameras[0].focal_u, 120, 1e-9);
  EXPECT_NEAR(light_field.cameras[0].centre_u, 71.5, 1e-9);
  expect_wall(read_view(light_field, 0), 255, kResampled);
  EXPECT_NE(light_field.notes.at(1).find("scaled"), std::string::npos);
}

TEST_F(PosedPictures, PictureOfAnotherShapeIsRefusedWithBothSizes) {
  Lens other = pinhole;
  other.width = 64;
  for (const std::string word : {"23×17", "64×17", "a.png"})
    expect_error(ErrorCode::kBadInput, word, [&] { two_views(other, picture()); });
}

TEST_F(PosedPictures, EightAndSixteenBitAreMixed) {
  save("a.png", picture(CV_8UC3));
  save("b.png", picture(CV_16UC3));
  const LightField light_field =
      posed_light_field({posed("a", pinhole), posed("b", pinhole, 1)}, "x");
  EXPECT_EQ(light_field.pixels->bit_depth(), 16);
  EXPECT_EQ(read_view(light_field, 0)(4, 3, 0), 257 * picture().at<cv::Vec3b>(3, 4)[2]);
  EXPECT_EQ(read_view(light_field, 1)(4, 3, 0), picture(CV_16UC3).at<cv::Vec3w>(3, 4)[2]);
}

TEST_F(PosedPictures, OrientationOfTheCameraIsNotApplied) {
  // A JPEG with an EXIF block that says "turn by 90 degrees".
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", picture(), jpeg);
  const std::string exif(
      "\xff\xe1\0\x22"
      "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0",
      36);
  const std::string turned = std::string(jpeg.begin(), jpeg.begin() + 2) + exif +
                             std::string(jpeg.begin() + 2, jpeg.end());
  write("a.png", turned);
  write("b.png", turned);
  const LightField light_field =
      posed_light_field({posed("a", pinhole), posed("b", pinhole, 1)}, "x");
  EXPECT_EQ(light_field.width, kWidth);
  EXPECT_EQ(read_view(light_field, 0).width(), kWidth);
  EXPECT_NE(light_field.notes.at(0).find("orientation"), std::string::npos);
}

TEST_F(PosedPictures, ManyThreadsReadTheSame) {
  std::vector<PosedPicture> pictures;
  for (int i = 0; i < 6; ++i) {
    Lens lens = cushion;
    lens.params[3] += 0.01 * (i / 2);
    const std::string name = std::string("v") + std::to_string(i);
    save(name + ".png", seen_through(lens));
    pictures.push_back(posed(name, lens, i));
  }
  const LightField light_field = posed_light_field(pictures, "x");
  std::vector<Image<std::uint16_t>> alone, together(6);
  for (int i = 0; i < 6; ++i) alone.push_back(read_view(light_field, i));
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i)
    threads.emplace_back([&, i] { together[std::size_t(i)] = read_view(light_field, i); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(alone, together);
}

TEST_F(PosedPictures, BadOnesAreNamed) {
  const auto refused = [&](const std::string& word, const PosedPicture& b) {
    expect_error(ErrorCode::kBadInput, word, [&] {
      posed_light_field({posed("a", pinhole), b}, "x");
    });
  };
  save("a.png");
  refused("b.png", posed("b", pinhole, 1));
  save("b.png");
  write("c.png", "no picture");
  refused("c.png", posed("c", pinhole, 1));
  refused("one place", posed("b", pinhole, 0));
  PosedPicture one = posed("b", pinhole, 1);
  one.rotation *= 1.1;
  refused("rotation", one);
  one = posed("b", pinhole, std::nan(""));
  refused("finite", one);
  one = posed("b", pinhole, 1);
  one.mask = folder / "nowhere.png";
  refused("nowhere.png", one);
  save("mask.png", picture(CV_8UC1, 5, 5));
  one.mask = folder / "mask.png";
  refused("5×5", one);
  one = posed("b", {"SIMPLE_RADIAL", kWidth, kHeight, {30, 11.5, -150, -90}}, 1);
  refused("nothing is left", one);
  expect_error(ErrorCode::kBadInput, "only one",
               [&] { posed_light_field({posed("a", pinhole)}, "x"); });
  expect_error(ErrorCode::kBadInput, "none", [&] { posed_light_field({}, "x"); });
}

}  // namespace
}  // namespace gigaray
