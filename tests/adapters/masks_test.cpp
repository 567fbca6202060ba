// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Masks of pictures: their names, sizes and types; of rows and grids, and what is transparent.
#include "adapters/adapters_test.h"
#include "pictures/mask_folder.h"

namespace gigaray {
namespace {

class Masks : public AdaptersTest {
 protected:
  static constexpr int kEdge = 8;  ///< columns that masks hide

  /// Black on the left.
  static cv::Mat mask(int width = kWidth, int height = kHeight, double edge = kEdge) {
    cv::Mat mat(height, width, CV_8UC1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        mat.at<std::uint8_t>(v, u) = u + 0.5 < edge * width / kWidth ? 0 : 255;
    return mat;
  }
  void save_row(const std::string& extension = ".jpg") const {
    for (const char* name : {"v_1", "v_2", "v_3"}) save("lf/" + (name + extension));
  }
  LightField open() const {
    OpenOptions options;
    options.masks = folder / "masks";
    return open_light_field(folder / "lf", options);
  }
  static void expect_masked(const LightField& light_field, int view, int edge = kEdge) {
    ASSERT_TRUE(light_field.pixels->has_mask());
    const Image<std::uint16_t> picture = read_view(light_field, view);
    ASSERT_EQ(picture.channels(), 4);
    for (int v = 0; v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u)
        ASSERT_EQ(picture(u, v, 3) == 0, u < edge) << u << " " << v;
  }
  static std::string note_of(const LightField& light_field, const std::string& words) {
    for (const std::string& note : light_field.notes)
      if (note.find(words) != std::string::npos) return note;
    return {};
  }
};

TEST_F(Masks, AreFoundUnderTheNamesPeopleGiveThem) {
  save_row();
  for (const std::string name :
       {"v_2.jpg.png", "v_2.png", "V_2.PNG", "v_2.jpg", "mask_v_2.png", "v_2_mask.png",
        "v_2.mask.png", "V_2.JPG.png", "v_2.tif", "v_2.JPG.bmp"}) {
    SCOPED_TRACE(name);
    save("masks/" + name, mask());
    const LightField light_field = open();
    expect_masked(light_field, 1);
    expect_masked(light_field, 0, 0);
    EXPECT_NE(note_of(light_field, "2 of 3 pictures have no mask"), "");
    std::filesystem::remove_all(folder / "masks");
  }
}

TEST_F(Masks, OfAPathAreFoundInItsFolderFirst) {
  save("masks/left/a.png", mask());
  save("masks/a.png", mask());
  save("masks/b.png", mask());
  const MaskFolder masks(folder / "masks");
  EXPECT_EQ(masks.find("left/a.jpg"), folder / "masks/left/a.png");
  EXPECT_EQ(masks.find("right/a.jpg"), folder / "masks/a.png");
  EXPECT_EQ(masks.find("left/b.jpg"), folder / "masks/b.png");
  EXPECT_EQ(masks.find("c.jpg"), std::filesystem::path());
}

TEST_F(Masks, AJpegsBlackIsNotExact) {
  save_row();
  cv::Mat noisy = mask(160, 120);
  for (int v = 0; v < noisy.rows; ++v)
    for (int u = 0; u < noisy.cols; ++u) {
      auto& value = noisy.at<std::uint8_t>(v, u);
      value = value == 0 ? std::uint8_t((u + v) % 12) : std::uint8_t(255 - (u + v) % 12);
    }
  save("a.jpg", noisy);
  const Mask seen = read_mask(folder / "a.jpg", 160, 120, Orientation::kIgnored, 1e9);
  const int edge = int(std::ceil(8.0 * 160 / kWidth - 0.5));
  for (int u = 0; u < 160; ++u)
    EXPECT_TRUE(std::abs(u - edge) <= 2 || (seen(u, 60) != 0) == (u >= edge)) << u;
  // Grey of a type that keeps values is not black: COLMAP's rule.
  save("a.png", noisy);
  EXPECT_EQ(read_mask(folder / "a.png", 160, 120, Orientation::kIgnored, 1e9)(3, 3), 1);
}

TEST_F(Masks, OfAnotherSizeAreScaledAndOfAnotherShapeRefused) {
  save_row();
  save("masks/v_1.png", mask(2 * kWidth, 2 * kHeight));
  save("masks/v_2.png", mask(3 * kWidth, 3 * kHeight));
  const LightField light_field = open();
  expect_masked(light_field, 0);
  expect_masked(light_field, 1);
  EXPECT_NE(note_of(light_field, "2 masks have another size than the picture: scaled"), "");
  save("masks/v_3.png", mask(kHeight, kWidth));
  expect_error(ErrorCode::kBadInput, "17×23", [&] { open(); });
}

TEST_F(Masks, ThatAreDamagedOrMissingAreNamed) {
  save_row();
  expect_error(ErrorCode::kBadInput, "is no folder of masks", [&] { open(); });
  std::filesystem::create_directories(folder / "masks");
  expect_error(ErrorCode::kBadInput, "holds no mask of any picture", [&] { open(); });
  write("masks/v_1.png", "no picture");
  expect_error(ErrorCode::kBadInput, "v_1.png", [&] { open(); });
  save("masks/v_1.png", mask(401, 297));
  cut_short("masks/v_1.png", 0.7);
  save_row(".png");
  expect_error(ErrorCode::kBadInput, "v_1.png", [&] { read_view(open(), 0); });
}

TEST_F(Masks, MayBeInTheirAlphaChannel) {
  cv::Mat white(kHeight, kWidth, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kEdge; ++u) white.at<cv::Vec4b>(v, u)[3] = 0;
  save("a.png", white);
  const Mask seen = read_mask(folder / "a.png", kWidth, kHeight, Orientation::kIgnored, 1e9);
  EXPECT_EQ(seen(kEdge - 1, 3), 0);
  EXPECT_EQ(seen(kEdge, 3), 1);
}

TEST_F(Masks, OfAGridGoWithThemToo) {
  for (const char* name : {"0_0", "0_1", "1_0", "1_1"}) {
    save(std::string("lf/") + name + ".png");
    save(std::string("masks/") + name + ".png", mask());
  }
  const LightField light_field = open();
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  for (int view = 0; view < 4; ++view) expect_masked(light_field, view);
}

TEST_F(Masks, WhatIsTransparentInARowIsMasked) {
  for (const int type : {CV_8UC4, CV_16UC4}) {
    cv::Mat mat = picture(type);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        if (type == CV_8UC4)
          mat.at<cv::Vec4b>(v, u)[3] = u < kEdge ? 0 : 255;
        else
          mat.at<cv::Vec4w>(v, u)[3] = u < kEdge ? 0 : 65535;
    for (const char* name : {"lf/v_1.png", "lf/v_2.png", "lf/v_3.png"}) save(name, mat);
    const LightField light_field = open_light_field(folder / "lf");
    expect_masked(light_field, 2);
    EXPECT_NE(note_of(light_field, "alpha channel of 3 of 3 pictures masks"), "");
  }
}

TEST_F(Masks, AnOpaqueAlphaChannelIsNone) {
  cv::Mat mat = picture(CV_8UC4);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) mat.at<cv::Vec4b>(v, u)[3] = 255;
  for (const char* name : {"lf/v_1.png", "lf/v_2.png", "lf/v_3.png"}) save(name, mat);
  const LightField light_field = open_light_field(folder / "lf");
  EXPECT_FALSE(light_field.pixels->has_mask());
  EXPECT_NE(note_of(light_field, "alpha channel of the pictures is ignored"), "");
}

}  // namespace
}  // namespace gigaray
