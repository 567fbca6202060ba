// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "adapters/adapters_test.h"
#include "gigaray/adapters/maps.h"
#include "pictures/picture_alpha.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

int srgb(double light) {
  const double encoded =
      light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return int(std::lround(65535 * encoded));
}

class FloatPictures : public AdaptersTest {
 protected:
  /// Light from 0 to `most`, another one in every pixel and channel.
  static float light(int u, int v, int c, double most) {
    return float(most * (u + kWidth * v + 100 * c) / (kWidth * kHeight + 200.0));
  }

  template <class Value>
  void write_exr(const std::string& name, const std::vector<std::string>& channels, Value value,
                 Imath::Box2i shown = {{0, 0}, {kWidth - 1, kHeight - 1}},
                 Imath::Box2i data = {{0, 0}, {kWidth - 1, kHeight - 1}}) const {
    Imf::Header header(shown, data);
    const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
    std::vector<std::vector<float>> planes;
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      planes.emplace_back(std::size_t(width) * height);
      for (int i = 0; i < width * height; ++i)
        planes.back()[std::size_t(i)] = value(i % width, i / width, int(c));
    }
    for (std::size_t c = 0; c < channels.size(); ++c) {
      header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
      char* origin = reinterpret_cast<char*>(planes[c].data()) -
                     std::ptrdiff_t(sizeof(float)) * (data.min.x + data.min.y * width);
      buffer.insert(channels[c], Imf::Slice(Imf::FLOAT, origin, sizeof(float),
                                            sizeof(float) * std::size_t(width)));
    }
    Imf::OutputFile file((folder / name).c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  }

  void write_views(const std::vector<std::string>& channels, double most = 1) const {
    for (const char* name : {"render_1.exr", "render_2.exr", "render_3.exr"})
      write_exr(name, channels, [&](int u, int v, int c) { return light(u, v, c, most); });
  }

  static bool notes(const LightField& light_field, const std::string& words) {
    for (const std::string& note : light_field.notes)
      if (note.find(words) != std::string::npos) return true;
    return false;
  }
};

TEST_F(FloatPictures, LinearLightIsEncodedAsSrgb) {
  write_views({"R", "G", "B", "A", "Z"});
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.num_views(), 3);
  EXPECT_EQ(light_field.pixels->bit_depth(), 16);
  EXPECT_TRUE(notes(light_field, "(.exr) are taken as linear light: 1 is full scale"));
  const Image<std::uint16_t> picture = read_view(light_field, 0);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(picture(u, v, c), srgb(double(light(u, v, c, 1)))) << u << " " << v << " " << c;
}

TEST_F(FloatPictures, GreyAndLayersAreFound) {
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"Y"},
        {"Y", "A"},
        {"Z", "R"},
        {"View.Depth.Z", "View.Combined.R", "View.Combined.G", "View.Combined.B"},
        {"View.Diffuse.R", "View.Diffuse.G", "View.Diffuse.B"}}) {
    SCOPED_TRACE(channels.back());
    write_views(channels, 0.7);
    const LightField light_field = open_light_field(folder);
    const Image<std::uint16_t> picture = read_view(light_field, 1);
    const auto red = std::find_if(channels.begin(), channels.end(), [](const std::string& name) {
      return name.ends_with("R") || name == "Y";
    });
    EXPECT_EQ(picture(7, 5, 0), srgb(double(light(7, 5, int(red - channels.begin()), 0.7))));
    EXPECT_EQ(channels.size() < 3, picture(7, 5, 2) == picture(7, 5, 0));
  }
}

TEST_F(FloatPictures, TheFinishedPictureIsTakenBeforePasses) {
  for (const char* name : {"a_1.exr", "a_2.exr"})
    write_exr(
        name,
        {"A.Albedo.R", "A.Albedo.G", "A.Albedo.B", "A.Combined.R", "A.Combined.G", "A.Combined.B"},
        [](int, int, int c) { return c < 3 ? 1.0F : 0.2F; });
  EXPECT_EQ(read_view(open_light_field(folder), 0)(3, 3, 1), 65535);  // 0.2 is the brightest
}

TEST_F(FloatPictures, OneFullScaleForAllViewsHoweverBright) {
  for (const auto& [name, share] : {std::pair{"a_1.exr", 0.5}, {"a_2.exr", 1.0}, {"a_3.exr", 0.25}})
    write_exr(name, {"R", "G", "B"},
              [s = share](int u, int v, int c) { return light(u, v, c, 80 * s); });
  const LightField light_field = open_light_field(folder);
  EXPECT_FALSE(notes(light_field, ": 1 is full scale"));
  const auto first = read_view(light_field, 0), second = read_view(light_field, 1);
  // Half the light in one view is half the light in the other.
  EXPECT_NEAR(first(20, 8, 1) / 65535.0 + 0.055,
              (second(20, 8, 1) / 65535.0 + 0.055) * std::pow(0.5, 1 / 2.4), 2e-4);
  EXPECT_GT(first(20, 8, 1), 20000);
}

TEST_F(FloatPictures, WhatIsNoLightIsBlackAndSaid) {
  for (const char* name : {"a_1.exr", "a_2.exr"})
    write_exr(name, {"R", "G", "B"}, [](int u, int, int c) {
      const float bad[] = {NAN, kInfinity, -kInfinity, -1.0F};
      return u < 4 ? bad[u] : 0.1F * float(c + 1) + 0.01F * float(u);
    });
  const LightField light_field = open_light_field(folder);
  EXPECT_TRUE(notes(light_field, "are not finite or below 0 and become black"));
  const Image<std::uint16_t> picture = read_view(light_field, 0);
  for (int u = 0; u < 4; ++u) EXPECT_EQ(picture(u, 2, 1), 0) << u;
  EXPECT_EQ(picture(5, 2, 1), srgb(double(0.1F * 2 + 0.01F * 5)));
}

TEST_F(FloatPictures, TheShownWindowIsTheSizeOfTheView) {
  // A renderer crops to what it has drawn.
  const Imath::Box2i data{{3, 2}, {12, 9}}, shown{{0, 0}, {kWidth - 1, kHeight - 1}};
  const Imath::Box2i wide{{-2, -1}, {kWidth, kHeight}};
  const auto value = [](int u, int v, int c) { return light(u, v, c, 1); };
  write_exr("a_1.exr", {"R", "G", "B", "A"}, value, shown, data);
  write_exr("a_2.exr", {"R", "G", "B", "A"}, value, shown, wide);
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.width, kWidth);
  EXPECT_EQ(light_field.height, kHeight);
  const auto cropped = read_view(light_field, 0), over = read_view(light_field, 1);
  EXPECT_EQ(cropped(0, 0, 0), 0);
  EXPECT_EQ(cropped(5, 6, 2), srgb(double(light(2, 4, 2, 1))));
  EXPECT_EQ(over(5, 6, 2), srgb(double(light(7, 7, 2, 1))));
  const Mask opaque = read_alpha(folder / "a_1.exr", 1e9, {});
  EXPECT_EQ(opaque(0, 0), 0);
}

TEST_F(FloatPictures, DepthAloneIsNoView) {
  write_views({"Z"});
  expect_bad_input("has no colours, its channels are 'Z'");
  write_views({"normal.X", "normal.Y", "normal.Z"});
  expect_bad_input("a view needs R, G and B, or Y");
}

TEST_F(FloatPictures, MapsBesideUsualPicturesAreNoViews) {
  save("view_1.png");
  save("view_2.png");
  write_views({"R", "G", "B"});
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.num_views(), 2);
  EXPECT_EQ(light_field.views[0].name, "view_1");
}

TEST_F(FloatPictures, TiffRadianceAndPfmAreRead) {
  cv::Mat mat(kHeight, kWidth, CV_32FC3);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      for (int c = 0; c < 3; ++c) mat.at<cv::Vec3f>(v, u)[2 - c] = light(u, v, c, 1);
  for (const std::string extension : {".tif", ".hdr", ".pfm"}) {
    SCOPED_TRACE(extension);
    save("a_1" + extension, mat);
    save("a_2" + extension, mat);
    const LightField light_field = open_light_field(folder);
    EXPECT_TRUE(notes(light_field, "(" + extension + ") are taken as linear light"));
    const Image<std::uint16_t> picture = read_view(light_field, 0);
    // 8 bits of mantissa; OpenCV compresses TIFF with LogLuv, which is lossy.
    const double tolerance = extension == ".hdr" ? 700 : extension == ".tif" ? 5000 : 1;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(picture(9, 14, c), srgb(double(light(9, 14, c, 1))), tolerance);
    cut_short("a_2" + extension, 0.6);
    expect_error(ErrorCode::kBadInput, "a_2" + extension,
                 [&] { read_view(open_light_field(folder), 1); });
    std::filesystem::remove(folder / ("a_1" + extension));
    std::filesystem::remove(folder / ("a_2" + extension));
  }
}

TEST_F(FloatPictures, OneChannelPfmsAreMapsAndNoViews) {
  write_pfm(folder / "depth_1.pfm", FloatMap(7, 5, 1, 1.0F));
  write_pfm(folder / "depth_2.pfm", FloatMap(7, 5, 1, 1.0F));
  expect_bad_input("no pictures in this folder");
}

TEST_F(FloatPictures, DamagedExrIsNamed) {
  write_views({"R", "G", "B"});
  cut_short("render_2.exr", 0.7);
  expect_error(ErrorCode::kBadInput, "render_2.exr",
               [&] { read_view(open_light_field(folder), 1); });
  cut_short("render_2.exr", 0.05);
  EXPECT_TRUE(notes(open_light_field(folder), "left out: render_2.exr"));
}

}  // namespace
}  // namespace gigaray
