// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "adapters/adapters_test.h"
#include "adapters/picture_bytes.h"
#include "formats/file_type.h"
#include "gigaray/adapters/pictures.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

class PictureTypes : public AdaptersTest {
 protected:
  /// Three views under one pattern of names.
  void write_views(const std::string& extension, const std::string& bytes) const {
    for (const char* view : {"view_1", "view_2", "view_3"}) write(view + extension, bytes);
  }
  std::string encoded(const std::string& as, int type = CV_8UC3) const {
    save("encoded" + as, picture(type));
    const std::string bytes = read("encoded" + as);
    std::filesystem::remove(folder / ("encoded" + as));
    return bytes;
  }
  LightField open() const { return open_light_field(folder); }

  /// A little-endian TIFF that is a header and a directory of entries of one number each.
  static std::string tiff(const std::vector<std::pair<int, int>>& entries) {
    const auto number = [](long value, int size) {
      std::string bytes;
      for (int i = 0; i < size; ++i) bytes += char(value >> (8 * i) & 0xff);
      return bytes;
    };
    std::string bytes =
        "II*" + std::string(1, '\0') + number(8, 4) + number(long(entries.size()), 2);
    for (const auto& [tag, value] : entries)
      bytes += number(tag, 2) + number(4, 2) + number(1, 4) + number(value, 4);
    return bytes + number(0, 4);
  }
};

TEST_F(PictureTypes, ContentDecidesWhateverTheName) {
  const std::string jpeg = encoded(".jpg"), png = encoded(".png"), tif = encoded(".tif");
  for (const auto& [extension, bytes] : {std::pair<std::string, std::string>{".jfif", jpeg},
                                         {".JPG_large", jpeg},
                                         {"", jpeg},
                                         {".jpg", png},
                                         {".png", jpeg},
                                         {".data", tif},
                                         {"", png},
                                         {".JPEG", png},
                                         {".bin", png}}) {
    SCOPED_TRACE(extension);
    write_views(extension, bytes);
    write("notes.txt", "three views");
    write("LICENSE", "Do what you want.");
    const LightField light_field = open();
    EXPECT_EQ(light_field.num_views(), 3);
    EXPECT_EQ(light_field.width, kWidth);
    EXPECT_EQ(read_view(light_field, 1).height(), kHeight);
    for (const char* view : {"view_1", "view_2", "view_3"})
      std::filesystem::remove(folder / (view + extension));
  }
}

TEST_F(PictureTypes, FormatsOfPhonesAndOfTheWebAreRead) {
  for (const auto& [extension, digits] : {std::pair{".heic", kHeic},
                                          {".hif", kHeic},
                                          {".HEIF", kHeic},
                                          {"", kHeic},
                                          {".avif", kAvif},
                                          {".jpg", kAvif},
                                          {".jxl", kJpegXl},
                                          {".png", kJpegXl},
                                          {"", kJpegXl}}) {
    SCOPED_TRACE(extension);
    const std::string name = std::string("view_1") + extension;
    write_views(extension, bytes_of(digits));
    const LightField light_field = open();
    EXPECT_EQ(light_field.num_views(), 3);
    const Image<std::uint16_t> picture = read_view(light_field, 0);
    ASSERT_EQ(picture.width(), 16);
    ASSERT_EQ(picture.height(), 8);
    EXPECT_GT(picture(8, 0, 0), 220);
    EXPECT_LT(picture(8, 0, 2), 40);
    EXPECT_GT(picture(8, 7, 2), 200);
    const std::string whole = read(name);
    for (const double share : {0.3, 0.6, 0.95}) {
      write(name, whole.substr(0, std::size_t(share * double(whole.size()))));
      expect_error(ErrorCode::kBadInput, name, [&] { read_picture(folder / name); });
    }
    for (const char* view : {"view_1", "view_2", "view_3"})
      std::filesystem::remove(folder / (std::string(view) + extension));
  }
}

TEST_F(PictureTypes, RawPhotographsAreNamedAndNotReadAsTheirPreview) {
  const std::string mosaic = tiff({{254, 0}, {262, 32803}}), preview = tiff({{254, 1}, {256, 160}});
  const std::string dng = tiff({{256, 160}, {50706, 0x401}}), plain = tiff({{256, 160}});
  const std::string cr2 = "II*" + std::string("\0\x10\0\0\0CR\2\0", 9) + std::string(40, 'x');
  const std::string cr3 = std::string("\0\0\0\x18", 4) + "ftypcrx " + std::string(40, 'x');
  for (const auto& [stated, bytes, word] :
       {std::tuple{"DSC_0001.NEF", plain, "NEF"},
        {"DSC_0001.ARW", plain, "ARW"},
        {"DSC_0001.dng", preview, "DNG"},
        {"DSC_0001.tif", dng, "DNG"},
        {"DSC_0001.tif", preview, "preview"},
        {"DSC_0001", mosaic, "raw photograph"},
        {"IMG_1.cr2", cr2, "CR2"},
        {"IMG_1", cr2, "CR2"},
        {"IMG_1.CR3", cr3, "CR3"},
        {"DSCF0001.RAF", std::string("FUJIFILMCCD-RAW 0201"), "RAF"}}) {
    const std::string name = stated;
    SCOPED_TRACE(name);
    write(name, bytes);
    write("readme.txt", "raw photographs");
    EXPECT_EQ(file_type(folder / name).kind, FileKind::kUnread);
    testing_support::expect_error(ErrorCode::kBadInput, {name, word, "dcraw"}, [&] { open(); });
    testing_support::expect_error(ErrorCode::kBadInput, {name, word, "dcraw"},
                                  [&] { open_light_field(folder / name); });
    testing_support::expect_error(ErrorCode::kBadInput, {name, word},
                                  [&] { read_picture(folder / name); });
    std::filesystem::remove(folder / name);
  }
}

TEST_F(PictureTypes, RawPhotographsBesideJpegsAreNoViews) {
  for (const std::string name : {"DSC_0001", "DSC_0002"}) {
    save(name + ".JPG.jpg");
    write(name + ".NEF", tiff({{256, 160}}));
  }
  EXPECT_EQ(open().num_views(), 2);
}

TEST_F(PictureTypes, VideoGetsTheLineThatCutsItIntoPictures) {
  const std::string mp4 = std::string("\0\0\0\x18", 4) + "ftypisom" + std::string(40, 'x');
  const std::string mov = std::string("\0\0\0\x14", 4) + "ftypqt  " + std::string(40, 'x');
  const std::string mkv = "\x1a\x45\xdf\xa3" + std::string(60, 'x');
  const std::string avi = "RIFF\1\1\1\1AVI LIST" + std::string(40, 'x');
  for (const auto& [stated, bytes] : {std::pair{"clip.mp4", mp4},
                                      {"clip.MOV", mov},
                                      {"clip", mp4},
                                      {"clip.mkv", mkv},
                                      {"clip.avi", avi},
                                      {"clip.mp4", avi},
                                      {"clip.m4v", std::string("cut short")}}) {
    const std::string name = stated;
    SCOPED_TRACE(name);
    write(name, bytes);
    const std::vector<std::string> words{std::string("ffmpeg -i ") + name + " -vf fps=",
                                         "pictures/%05d.png"};
    testing_support::expect_error(ErrorCode::kBadInput, words, [&] { open(); });
    testing_support::expect_error(ErrorCode::kBadInput, words,
                                  [&] { open_light_field(folder / name); });
    // A single still does not hide it.
    save("cover.jpg");
    testing_support::expect_error(ErrorCode::kBadInput, words, [&] { open(); });
    std::filesystem::remove(folder / "cover.jpg");
    std::filesystem::remove(folder / name);
  }
}

TEST_F(PictureTypes, OtherTypesAreNamed) {
  write("a_1.psd", "8BPS" + std::string(60, 'x'));
  write("a_2.psd", "8BPS" + std::string(60, 'x'));
  testing_support::expect_error(ErrorCode::kBadInput, {"a_1.psd", "one of 2", "Photoshop"},
                                [&] { open(); });
}

TEST_F(PictureTypes, WhatIsNoPictureStaysNone) {
  write("a_1.txt", "P5 is a format");
  write("a_2", "BM");
  write("a_3", "");
  write("a_4.csv", "\x89PNG");
  write("a_5", "PK\3\4");
  expect_bad_input("no pictures in this folder (folders inside it are not searched)");
  save("rgb/a.png");
  expect_bad_input("one inside it holds pictures, name that: " + (folder / "rgb").string());
}

TEST_F(PictureTypes, TiffOfPackedBitsIsNoDamage) {
  // 258: bits per sample; 12 of them are packed.
  write("a.tif", tiff({{256, 4},
                       {257, 2},
                       {258, 12},
                       {259, 1},
                       {262, 1},
                       {273, 200},
                       {277, 1},
                       {278, 2},
                       {279, 12}}) +
                     std::string(200, 'x'));
  expect_error(ErrorCode::kBadInput, "-depth 16", [&] { read_picture(folder / "a.tif"); });
}

}  // namespace
}  // namespace gigaray
