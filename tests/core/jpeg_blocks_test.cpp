// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/jpeg_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/counting_pixels.h"
#include "support/jpeg_rounding.h"

namespace gigaray {
namespace {

using testing_support::jpeg_rounded;
using testing_support::JpegPixels;

/// Texture of all frequencies, strongest the lowest, of 8 bit. Sides: multiples of 16.
Image<std::uint16_t> texture(int width = 128, int height = 96) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> phase(0, 6.28), frequency(0.05, 2);
  Image<double> sum(width, height, 3, 120);
  for (int wave = 0; wave < 60; ++wave) {
    const double fu = frequency(random), fv = frequency(random) - 1, at = phase(random);
    const double size = 6 / (0.3 + std::hypot(fu, fv));
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        for (int c = 0; c < 3; ++c) sum(u, v, c) += size * std::sin(fu * u + fv * v + at * (c + 1));
  }
  Image<std::uint16_t> picture(width, height, 3);
  for (std::size_t i = 0; i < sum.size(); ++i)
    picture.data()[i] = std::uint16_t(std::lround(std::clamp(sum.data()[i], 0.0, 255.0)));
  return picture;
}

JpegTable rising(float least, float slope) {
  JpegTable table;
  for (int k = 0; k < 8; ++k)
    for (int l = 0; l < 8; ++l) table(k, l) = std::round(least + slope * float(k + l));
  return table;
}

double rms_error(const Image<std::uint16_t>& picture, double scale,
                 const Image<std::uint16_t>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += std::pow(picture.data()[i] / scale - truth.data()[i], 2);
  return std::sqrt(sum / double(truth.size()));
}

LightField field_of(std::shared_ptr<const PixelSource> pixels, const Image<std::uint16_t>& size) {
  LightField field;
  field.width = size.width();
  field.height = size.height();
  field.views = {{"left", -1, 0}, {"centre", 0, 0}, {"right", 1, 0}};
  field.pixels = std::move(pixels);
  return field;
}

class SamePicture : public PixelSource {
 public:
  SamePicture(Image<std::uint16_t> picture, int bits, bool has_mask = false)
      : picture_(std::move(picture)), bits_(bits), has_mask_(has_mask) {}
  Image<std::uint16_t> read(int) const override { return picture_; }
  bool has_mask() const override { return has_mask_; }
  int bit_depth() const override { return bits_; }

 private:
  Image<std::uint16_t> picture_;
  int bits_;
  bool has_mask_;
};

TEST(JpegBlocks, StepsAreFoundInThePixels) {
  const JpegSteps made{rising(6, 2), rising(9, 3), 1, 1};
  const auto found = find_jpeg_steps(jpeg_rounded(texture(), made));
  ASSERT_TRUE(found);
  ASSERT_TRUE(found->chroma);
  EXPECT_EQ(found->chroma_width * 10 + found->chroma_height, 11);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      EXPECT_EQ(found->luma(k, l), made.luma(k, l)) << k << " " << l;
      EXPECT_EQ((*found->chroma)(k, l), (*made.chroma)(k, l)) << k << " " << l;
    }
}

TEST(JpegBlocks, ChromaOfHalfTheSizeIsFound) {
  for (const auto& [columns, rows] : {std::pair{2, 1}, {2, 2}}) {
    const JpegSteps made{rising(6, 2), rising(9, 3), columns, rows};
    const auto found = find_jpeg_steps(jpeg_rounded(texture(), made));
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->chroma);
    EXPECT_EQ(found->chroma_width, columns);
    EXPECT_EQ(found->chroma_height, rows);
  }
}

TEST(JpegBlocks, OtherPicturesShowNone) {
  EXPECT_FALSE(find_jpeg_steps(texture()));
  EXPECT_FALSE(find_jpeg_steps(Image<std::uint16_t>(64, 64, 3, 77)));
  EXPECT_FALSE(find_jpeg_steps(Image<std::uint16_t>(5, 3, 3, 9)));
  std::mt19937 random(5);
  Image<std::uint16_t> noise(64, 64, 3), stripes(64, 64, 3);
  for (std::uint16_t& value : noise) value = std::uint16_t(random() % 256);
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u)
      for (int c = 0; c < 3; ++c) stripes(u, v, c) = u / 4 % 2 ? 200 : 40;
  EXPECT_FALSE(find_jpeg_steps(noise));
  EXPECT_FALSE(find_jpeg_steps(stripes));
  // Cut since: the blocks begin elsewhere.
  const Image<std::uint16_t> coded = jpeg_rounded(texture(), {rising(6, 2), {}, 1, 1});
  Image<std::uint16_t> cut(coded.width() - 8, coded.height() - 8, 3);
  for (int v = 0; v < cut.height(); ++v)
    for (int u = 0; u < cut.width(); ++u)
      for (int c = 0; c < 3; ++c) cut(u, v, c) = coded(u + 3, v + 5, c);
  EXPECT_FALSE(find_jpeg_steps(cut));
}

TEST(JpegBlocks, CleanedPictureIsNearerToWhatWasCoded) {
  const Image<std::uint16_t> truth = texture();
  const JpegSteps steps{rising(10, 4), rising(12, 5), 2, 2};
  const Image<std::uint16_t> coded = jpeg_rounded(truth, steps);
  const Image<std::uint16_t> cleaned = without_jpeg_blocks(coded, steps);
  EXPECT_LT(rms_error(cleaned, 257, truth), 0.95 * rms_error(coded, 1, truth));
}

TEST(JpegBlocks, FlatPicturesOfAnySizeStayAsTheyAre) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {17, 23}}) {
    const Image<std::uint16_t> flat(width, height, 3, 128);
    const auto cleaned = without_jpeg_blocks(flat, {rising(6, 2), rising(9, 3), 2, 2});
    ASSERT_EQ(cleaned.size(), flat.size());
    for (const std::uint16_t value : cleaned) EXPECT_NEAR(value, 128 * 257, 1);
  }
}

TEST(JpegBlocks, FieldIsCleanedOnlyWhereItsCentreShowsThem) {
  const Image<std::uint16_t> picture = texture();
  const JpegSteps steps{rising(6, 2), rising(9, 3), 1, 1};
  const auto clean = std::make_shared<SamePicture>(picture, 8);
  EXPECT_EQ(without_jpeg_blocks(field_of(clean, picture)).pixels, clean);

  LightField coded = field_of(std::make_shared<JpegPixels>(clean, steps), picture);
  const auto counting = testing_support::count_reads(coded);
  const LightField cleaned = without_jpeg_blocks(coded);
  EXPECT_EQ(counting->total(), 1);
  EXPECT_EQ(cleaned.pixels->bit_depth(), 16);
  const auto view = jpeg_rounded(picture, steps);
  EXPECT_EQ(read_view(cleaned, 2), without_jpeg_blocks(view, *find_jpeg_steps(view)));
  EXPECT_EQ(counting->total(), 2);

  const auto of_16_bit = std::make_shared<SamePicture>(view, 16);
  EXPECT_EQ(without_jpeg_blocks(field_of(of_16_bit, picture)).pixels, of_16_bit);
}

TEST(JpegBlocks, MaskAndViewsWithoutBlocksStay) {
  class Mixed : public PixelSource {
   public:
    Image<std::uint16_t> read(int view_idx) const override {
      const Image<std::uint16_t> plain = texture();
      const auto colours = view_idx == 1 ? jpeg_rounded(plain, {rising(6, 2), {}, 1, 1}) : plain;
      Image<std::uint16_t> picture(plain.width(), plain.height(), 4);
      for (int v = 0; v < plain.height(); ++v)
        for (int u = 0; u < plain.width(); ++u) {
          for (int c = 0; c < 3; ++c) picture(u, v, c) = colours(u, v, c);
          picture(u, v, 3) = u % 3 ? 255 : 0;
        }
      return picture;
    }
    bool has_mask() const override { return true; }
    int bit_depth() const override { return 8; }
  };
  const auto mixed = std::make_shared<Mixed>();
  const LightField cleaned = without_jpeg_blocks(field_of(mixed, texture()));
  ASSERT_TRUE(cleaned.pixels->has_mask());
  for (const int view : {0, 1}) {
    const auto before = mixed->read(view), after = read_view(cleaned, view);
    for (int u = 0; u < 50; ++u) EXPECT_EQ(after(u, 9, 3) > 0, before(u, 9, 3) > 0);
  }
  const auto before = mixed->read(0), after = read_view(cleaned, 0);
  for (int u = 0; u < 50; ++u) EXPECT_EQ(after(u, 9, 1), 257 * before(u, 9, 1));
}

}  // namespace
}  // namespace gigaray
