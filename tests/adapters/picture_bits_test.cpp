// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "adapters/adapters_test.h"
#include "pictures/picture_alpha.h"
#include "pictures/picture_values.h"

namespace gigaray {
namespace {

/// 16-bit pictures that hold fewer bits, as cameras of machine vision write them.
class PictureBits : public AdaptersTest {
 protected:
  static cv::Mat of_bits(int bits, int first = 0, int type = CV_16UC3) {
    cv::Mat mat(kHeight, kWidth, type);
    const int channels = mat.channels(), most = (1 << bits) - 1;
    for (int v = 0; v < kHeight; ++v)
      for (int i = 0; i < kWidth * channels; ++i)
        mat.ptr<std::uint16_t>(v)[i] = std::uint16_t((first + 37 * v + 11 * i) % (most + 1));
    mat.ptr<std::uint16_t>(0)[0] = std::uint16_t(most);
    return mat;
  }
  LightField open_views(const std::vector<cv::Mat>& views, const std::string& extension) const {
    for (std::size_t i = 0; i < views.size(); ++i)
      save("view_" + std::to_string(i + 1) + extension, views[i]);
    return open_light_field(folder);
  }
  static std::string note_of_bits(const LightField& light_field) {
    for (const std::string& note : light_field.notes)
      if (note.find("-bit pictures use") != std::string::npos) return note;
    return {};
  }
};

TEST_F(PictureBits, FullScaleComesFromTheValuesAndIsSaid) {
  for (const int bits : {8, 10, 12, 14})
    for (const std::string extension : {".png", ".tif", ".ppm"}) {
      SCOPED_TRACE(std::to_string(bits) + extension);
      const LightField light_field =
          open_views({of_bits(bits), of_bits(bits, 1), of_bits(bits, 2)}, extension);
      const int most = (1 << bits) - 1;
      EXPECT_EQ(note_of_bits(light_field), "the 16-bit pictures use " + std::to_string(bits) +
                                               " bits: " + std::to_string(most) + " is full scale");
      const Image<std::uint16_t> picture = read_view(light_field, 1);
      const cv::Mat stored = of_bits(bits, 1);
      for (int u = 0; u < kWidth; ++u)
        ASSERT_EQ(picture(u, 3, 0), stored.at<cv::Vec3w>(3, u)[2] << (16 - bits));
      EXPECT_GE(read_view(light_field, 0)(0, 0, 2), 65535 - (1 << (16 - bits)));
      for (int i = 1; i <= 3; ++i)
        std::filesystem::remove(folder / ("view_" + std::to_string(i) + extension));
    }
}

TEST_F(PictureBits, AllBitsAndThoseOnTheLeftStayAsTheyAre) {
  cv::Mat left = of_bits(10);
  left *= 64;
  for (const cv::Mat& view : {picture(CV_16UC3), left}) {
    const LightField light_field = open_views({view, view}, ".png");
    EXPECT_EQ(note_of_bits(light_field), "");
    EXPECT_EQ(read_view(light_field, 0)(5, 6, 0), view.at<cv::Vec3w>(6, 5)[2]);
  }
}

TEST_F(PictureBits, OneScaleForAllViews) {
  // The first one is dark: the others say how many bits there are.
  cv::Mat dark = of_bits(7);
  const LightField light_field = open_views({dark, of_bits(12), dark}, ".png");
  EXPECT_NE(note_of_bits(light_field).find("4095 is full scale"), std::string::npos);
  EXPECT_EQ(read_view(light_field, 0)(5, 6, 0), dark.at<cv::Vec3w>(6, 5)[2] << 4);
}

TEST_F(PictureBits, RoundingAboveFullScaleIsNoOtherScale) {
  cv::Mat scaled = of_bits(12);
  scaled.at<cv::Vec3w>(2, 2) = cv::Vec3w(4096, 4100, 4095);  // 65535 / 16 and a little more
  const LightField light_field = open_views({scaled, of_bits(12)}, ".png");
  EXPECT_NE(note_of_bits(light_field).find("4095 is full scale"), std::string::npos);
  EXPECT_EQ(read_view(light_field, 0)(2, 2, 1), 65535);
}

TEST_F(PictureBits, BrighterThanWhatWasLookedAtIsClippedAndNeverWraps) {
  StoredPicture stored;
  stored.whole = Image<std::uint16_t>(2, 1, 3, 1023);
  stored.whole(1, 0, 1) = 1024;
  stored.whole(1, 0, 2) = 65535;
  ValueScale scale;
  scale.bits_of_16 = 10;
  const Image<std::uint16_t> picture = colours_of_16_bit(stored, Samples::k16, scale);
  EXPECT_EQ(picture(0, 0, 0), 1023 << 6);
  EXPECT_EQ(picture(1, 0, 1), 65535);
  EXPECT_EQ(picture(1, 0, 2), 65535);
}

TEST_F(PictureBits, BlackPicturesHaveNoScale) {
  const LightField light_field =
      open_views({cv::Mat::zeros(9, 7, CV_16UC3), cv::Mat::zeros(9, 7, CV_16UC3)}, ".png");
  EXPECT_EQ(note_of_bits(light_field), "");
}

TEST_F(PictureBits, IntegersOf32BitAreRead) {
  cv::Mat mat(kHeight, kWidth, CV_32SC1);
  for (int v = 0; v < kHeight; ++v)
    for (int i = 0; i < kWidth; ++i) mat.ptr<int>(v)[i] = 2000 * v + 900 * i;
  mat.ptr<int>(0)[0] = (1 << 18) - 1;
  const LightField light_field = open_views({mat, mat}, ".tif");
  EXPECT_NE(note_of_bits(light_field).find("the 32-bit pictures use 18 bits"), std::string::npos);
  EXPECT_EQ(read_view(light_field, 1)(8, 9, 0), mat.at<int>(9, 8) >> 2);
}

TEST_F(PictureBits, HalfOpaqueIsHalfOfTheBits) {
  cv::Mat mat = of_bits(10, 0, CV_16UC4);
  mat.at<cv::Vec4w>(2, 3)[3] = 511;
  mat.at<cv::Vec4w>(2, 4)[3] = 512;
  save("a.png", mat);
  ValueScale scale;
  scale.bits_of_16 = 10;
  const Mask opaque = read_alpha(folder / "a.png", 1e9, scale);
  EXPECT_EQ(opaque(3, 2), 0);
  EXPECT_EQ(opaque(4, 2), 1);
}

TEST_F(PictureBits, DamageAmongThePicturesThatAreLookedAtIsNamedWhenItIsRead) {
  for (const char* name : {"view_1.png", "view_2.png", "view_3.png"}) save(name, of_bits(10));
  std::string bytes = read("view_2.png");
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 60; ++i) bytes[i] = char(0xff);
  write("view_2.png", bytes);
  const LightField light_field = open_light_field(folder);
  EXPECT_NE(note_of_bits(light_field), "");
  expect_error(ErrorCode::kBadInput, "view_2.png", [&] { read_view(light_field, 1); });
}

}  // namespace
}  // namespace gigaray
