// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pictures.h"

#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

class Pictures : public AdaptersTest {
 protected:
  static void expect_same(const Image<std::uint16_t>& rgb, const cv::Mat& bgr) {
    ASSERT_EQ(rgb.width(), bgr.cols);
    ASSERT_EQ(rgb.height(), bgr.rows);
    ASSERT_EQ(rgb.channels(), 3);
    const int channels = bgr.channels();
    for (int v = 0; v < bgr.rows; ++v)
      for (int u = 0; u < bgr.cols; ++u)
        for (int c = 0; c < 3; ++c) {
          const int i = u * channels + (channels < 3 ? 0 : 2 - c);
          const int expected =
              bgr.depth() == CV_8U ? bgr.ptr<std::uint8_t>(v)[i] : bgr.ptr<std::uint16_t>(v)[i];
          ASSERT_EQ(rgb(u, v, c), expected) << u << " " << v << " " << c;
        }
  }
};

TEST_F(Pictures, EveryLosslessFormatGivesItsValues) {
  for (const int type : {CV_8UC3, CV_16UC3, CV_8UC1, CV_16UC1})
    for (const std::string name : {"a.png", "a.tif", "a.ppm", "a.bmp"}) {
      if (name == "a.bmp" && type != CV_8UC3) continue;
      SCOPED_TRACE(name + " of OpenCV type " + std::to_string(type));
      const bool grey = CV_MAT_CN(type) == 1;
      const std::string file = name == "a.ppm" && grey ? "a.pgm" : name;
      save(file, picture(type));
      int bit_depth = 0;
      expect_same(read_picture(folder / file, &bit_depth), picture(type));
      EXPECT_EQ(bit_depth, CV_MAT_DEPTH(type) == CV_8U ? 8 : 16);
    }
}

TEST_F(Pictures, AlphaIsDroppedAndColoursStay) {
  save("a.png", picture(CV_8UC4));
  expect_same(read_picture(folder / "a.png"), picture(CV_8UC4));
  save("b.png", picture(CV_16UC4));
  expect_same(read_picture(folder / "b.png"), picture(CV_16UC4));
}

TEST_F(Pictures, PngIsReadBackByAnotherLibrary) {
  for (const int bit_depth : {8, 16})
    for (const int channels : {1, 3}) {
      Image<std::uint16_t> written(5, 3, channels);
      for (std::size_t i = 0; i < written.size(); ++i)
        written.data()[i] = std::uint16_t(i * (bit_depth == 8 ? 5 : 1301));
      write_png(folder / "a.png", written, bit_depth);
      const cv::Mat seen = cv::imread((folder / "a.png").string(), cv::IMREAD_UNCHANGED);
      ASSERT_EQ(seen.type(), CV_MAKETYPE(bit_depth == 8 ? CV_8U : CV_16U, channels));
      const Image<std::uint16_t> again = read_picture(folder / "a.png");
      expect_same(again, seen);
      EXPECT_EQ(again(4, 2, 2), written(4, 2, channels - 1));
    }
}

TEST_F(Pictures, OrientationOfTheCameraIsApplied) {
  save("plain.jpg", picture());
  const std::string plain = read("plain.jpg");
  // EXIF: one entry, tag 0x0112 orientation, type short, count 1.
  for (const char orientation : {1, 3, 6, 8}) {
    std::string exif("Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 24);
    exif += std::string({orientation, 0, 0, 0, 0, 0, 0, 0});
    const std::string segment = "\xff\xe1" + std::string({char(0), char(exif.size() + 2)}) + exif;
    write("turned.jpg", plain.substr(0, 2) + segment + plain.substr(2));
    const Image<std::uint16_t> stored = read_picture(folder / "plain.jpg");
    const Image<std::uint16_t> seen = read_picture(folder / "turned.jpg");
    const bool swapped = orientation >= 5;
    ASSERT_EQ(seen.width(), swapped ? kHeight : kWidth);
    ASSERT_EQ(seen.height(), swapped ? kWidth : kHeight);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const int right = kWidth - 1 - u, bottom = kHeight - 1 - v;
        const std::uint16_t found = orientation == 1   ? seen(u, v, 1)
                                    : orientation == 3 ? seen(right, bottom, 1)
                                    : orientation == 6 ? seen(bottom, u, 1)
                                                       : seen(v, right, 1);
        ASSERT_EQ(found, stored(u, v, 1)) << int(orientation);
      }
  }
}

TEST_F(Pictures, FileThatIsCutShortIsNamed) {
  for (const std::string name : {"a.jpg", "a.png", "a.tif", "a.webp"})
    for (const double share : {0.05, 0.5, 0.97}) {
      SCOPED_TRACE(name + " " + std::to_string(share));
      save(name, picture(CV_8UC3, 301, 203));
      cut_short(name, share);
      testing::internal::CaptureStderr();
      expect_error(ErrorCode::kBadInput, name, [&] { read_picture(folder / name); });
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
}

TEST_F(Pictures, DamagedFileIsNamed) {
  for (const std::string name : {"a.jpg", "a.png"}) {
    save(name, picture(CV_8UC3, 301, 203));
    std::string bytes = read(name);
    for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 400; ++i) bytes[i] = char(0xff);
    write(name, bytes);
    testing::internal::CaptureStderr();
    expect_error(ErrorCode::kBadInput, name, [&] { read_picture(folder / name); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

}  // namespace
}  // namespace gigaray
