// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/pictures.h"

#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

FloatMap sample_map(int width = 7, int height = 5) {
  FloatMap map(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) map(u, v) = float(v) * 1234.5f - float(u) / 3;
  map(2, 1) = kNoEstimate;
  return map;
}

// Same bits, so that NaN equals NaN.
bool same(const FloatMap& a, const FloatMap& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class Maps : public AdaptersTest {
 protected:
  void expect_damaged(const std::string& name, const std::string& word) const {
    expect_error(ErrorCode::kBadInput, name, [&] { read_float_map(folder / name); });
    expect_error(ErrorCode::kBadInput, word, [&] { read_float_map(folder / name); });
  }
};
class Pfm : public Maps {};
class Npy : public Maps {};
class Exr : public Maps {};
class Png16 : public Maps {};
class DepthPicture : public Maps {};
class DepthOutput : public Maps {};

TEST_F(Pfm, ReadsWhatItWrote) {
  FloatMap map = sample_map();
  map(0, 0) = std::numeric_limits<float>::infinity();
  write_pfm(folder / "map.pfm", map);
  EXPECT_TRUE(same(read_float_map(folder / "map.pfm"), map));
  EXPECT_EQ(names(), std::set<std::string>{"map.pfm"});
}

TEST_F(Pfm, RowsAreStoredFromBottomToTop) {
  const std::string one("\x00\x00\x80\x3f", 4), two("\x00\x00\x00\x40", 4);
  write("map.pfm", "Pf\n1 2\n-1\n" + two + one);
  const FloatMap map = read_pfm(folder / "map.pfm");
  EXPECT_EQ(map(0, 0), 1);
  EXPECT_EQ(map(0, 1), 2);
}

TEST_F(Pfm, PositiveScaleMeansBigEndian) {
  write("map.pfm", std::string("Pf\r\t1 1 1.0\n\x3f\x80\x00\x00", 16));
  EXPECT_EQ(read_pfm(folder / "map.pfm")(0, 0), 1);
}

TEST_F(Pfm, DoesNotDependOnTheLocale) {
  const CommaLocale locale;
  const FloatMap map = sample_map(1031, 2);
  write_pfm(folder / "map.pfm", map);
  EXPECT_TRUE(read("map.pfm").starts_with("Pf\n1031 2\n-1.0\n"));
  EXPECT_TRUE(same(read_pfm(folder / "map.pfm"), map));
}

TEST_F(Pfm, DamagedFileIsNamed) {
  write_pfm(folder / "map.pfm", sample_map());
  const std::string whole = read("map.pfm");
  write("short.pfm", whole.substr(0, whole.size() - 1));
  expect_damaged("short.pfm", "cut short");
  write("long.pfm", whole + "x");
  expect_damaged("long.pfm", "too long");
  write("colour.pfm", "PF\n1 1\n-1\n000000000000");
  expect_damaged("colour.pfm", "three channels");
  for (const std::string header :
       {"", "P5\n1 1\n-1\n", "Pf\n", "Pf\n0 1\n-1\n", "Pf\n1.5 1\n-1\n", "Pf\n1 99999999999\n-1\n",
        "Pf\nnan 1\n-1\n", "Pf\n1 1\n0\n", "Pf\n1 1\nnan\n", "Pf\n1 1\n-1"}) {
    write("header.pfm", header);
    expect_damaged("header.pfm", "");
  }
}

TEST_F(Maps, MissingFileIsNamed) {
  for (const std::string name : {"none.pfm", "none.npy"})
    expect_error(ErrorCode::kIo, name, [&] { read_float_map(folder / name); });
  expect_error(ErrorCode::kBadInput, ".pfm", [&] { read_float_map(folder / "map.txt"); });
}

TEST_F(Maps, FolderThatIsNotThereIsNamed) {
  const std::filesystem::path place = folder / "none" / "map";
  const DisparityRange range{0, 1};
  const auto expect_named = [&](auto call) { expect_error(ErrorCode::kIo, place.string(), call); };
  expect_named([&] { write_pfm(place, sample_map()); });
  expect_named([&] { write_npy(place, sample_map()); });
  expect_named([&] { write_exr(place, sample_map()); });
  expect_named([&] { write_png16(place, sample_map(), range); });
  expect_named([&] { write_depth_picture(place, sample_map(), range); });
}

TEST_F(Maps, FullDiskLeavesTheOldFile) {
  write("map.pfm", "old");
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  expect_error(ErrorCode::kIo, "map.pfm",
               [&] { write_pfm(folder / "map.pfm", sample_map(64, 64)); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(names(), std::set<std::string>{"map.pfm"});
  EXPECT_EQ(read("map.pfm"), "old");
}

TEST_F(Npy, ReadsWhatItWrote) {
  write_npy(folder / "map.npy", sample_map());
  EXPECT_TRUE(same(read_float_map(folder / "map.npy"), sample_map()));
}

TEST_F(Npy, HeaderFollowsTheFormat) {
  write_npy(folder / "map.npy", sample_map(7, 5));
  const std::string bytes = read("map.npy");
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t values = 10 + std::uint8_t(bytes[8]) + 256 * std::uint8_t(bytes[9]);
  EXPECT_EQ(values % 64, 0);
  EXPECT_EQ(bytes[values - 1], '\n');
  EXPECT_EQ(bytes.size() - values, 4 * 7 * 5);
  EXPECT_NE(bytes.find("'shape': (5, 7)"), std::string::npos);
}

TEST_F(Npy, DoublesAreReadAsFloats) {
  const std::string header = "{'descr': '>f8', 'fortran_order': False, 'shape': (1, 2), }\n";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += {char(header.size()), '\0'};
  bytes += header + std::string("\x3f\xf8\0\0\0\0\0\0\xc0\x00\0\0\0\0\0\0", 16);
  write("map.npy", bytes);
  const FloatMap map = read_npy(folder / "map.npy");
  EXPECT_EQ(map(0, 0), 1.5f);
  EXPECT_EQ(map(1, 0), -2.0f);
}

TEST_F(Npy, DamagedFileIsNamed) {
  write_npy(folder / "map.npy", sample_map());
  const std::string whole = read("map.npy");
  write("short.npy", whole.substr(0, whole.size() - 1));
  expect_damaged("short.npy", "cut short");
  write("header.npy", whole.substr(0, 40));
  expect_damaged("header.npy", "header");
  write("magic.npy", "x" + whole);
  expect_damaged("magic.npy", "no NumPy file");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string bytes = whole;
    bytes.replace(bytes.find(from), from.size(), to);
    return bytes;
  };
  write("type.npy", changed("<f4", "<i4"));
  expect_damaged("type.npy", "float32");
  write("order.npy", changed("False", "True "));
  expect_damaged("order.npy", "Fortran");
  write("shape.npy", changed("(5, 7)", "(35,) "));
  expect_damaged("shape.npy", "two dimensions");
}

TEST_F(Exr, ReadsWhatItWrote) {
  write_exr(folder / "map.exr", sample_map());
  EXPECT_TRUE(same(read_float_map(folder / "map.exr"), sample_map()));
  EXPECT_EQ(names(), std::set<std::string>{"map.exr"});
}

TEST_F(Exr, DamagedFileIsNamed) {
  write_exr(folder / "map.exr", sample_map(301, 203));
  cut_short("map.exr", 0.5);
  expect_damaged("map.exr", "damaged");
  write("text.exr", "no picture");
  expect_damaged("text.exr", "damaged");
}

TEST_F(Png16, ScaleGivesTheValuesBack) {
  const DisparityRange range{-2, 3};
  FloatMap map = sample_map();
  for (float& value : map) value = std::fmod(value, 2.0f);
  map(0, 0) = -2;
  map(1, 0) = 3;
  map(2, 0) = 99;
  const Png16Scale scale = write_png16(folder / "map.png", map, range);
  const cv::Mat samples = cv::imread((folder / "map.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(samples.type(), CV_16UC1);
  ASSERT_EQ(samples.size(), cv::Size(7, 5));
  EXPECT_EQ(samples.at<std::uint16_t>(0, 0), 1);
  EXPECT_EQ(samples.at<std::uint16_t>(0, 1), 65535);
  EXPECT_EQ(samples.at<std::uint16_t>(0, 2), 65535) << "values outside are clamped";
  EXPECT_EQ(samples.at<std::uint16_t>(1, 2), 0) << "NaN";
  for (int v = 1; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u)
      if (!std::isnan(map(u, v))) {
        EXPECT_NEAR(scale.offset + scale.scale * samples.at<std::uint16_t>(v, u), map(u, v),
                    0.51 * scale.scale);
      }
}

TEST_F(DepthPicture, NearIsRedFarIsBlueNothingIsBlack) {
  FloatMap map(3, 1);
  map(0, 0) = 0.8f;
  map(1, 0) = -0.8f;
  map(2, 0) = kNoEstimate;
  write_depth_picture(folder / "depth.png", map, {-1, 1});
  const cv::Mat seen = cv::imread((folder / "depth.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(seen.type(), CV_8UC3);
  const auto near = seen.at<cv::Vec3b>(0, 0), far = seen.at<cv::Vec3b>(0, 1);
  EXPECT_GT(near[2], near[0] + 50);
  EXPECT_GT(far[0], far[2] + 50);
  EXPECT_EQ(seen.at<cv::Vec3b>(0, 2), cv::Vec3b(0, 0, 0));
}

/// Two views of 5 x 3 px.
LightField small_field() {
  LightField light_field;
  light_field.width = 5;
  light_field.height = 3;
  light_field.views = {{"a", -0.5, 0}, {"b", 0.5, 0}};
  light_field.pixels = pixels_in_memory({2, Image<std::uint16_t>(5, 3, 3, 77)}, 8);
  return light_field;
}

TEST_F(DepthOutput, MetricDepthIsThereWhenTheRigIsKnown) {
  const FloatMap disparity(5, 3, 1, 2.5f), confidence(5, 3, 1, 1);
  for (const bool known : {false, true}) {
    LightField light_field = small_field();
    light_field.rig.focal_px = 1000;
    if (known) light_field.rig.baseline = 0.025;
    light_field.rig.focus_distance = 5;
    const std::filesystem::path target = folder / (known ? "known" : "unknown");
    DepthFolder out(target, {}, {});
    out.describe(light_field);
    out.write_view(0, disparity, confidence, {-1, 1}, true);
    out.commit("{}");
    EXPECT_EQ(exists(target / "depth.pfm"), known);
    EXPECT_EQ(exists(target / "a" / "depth.pfm"), known);
    EXPECT_FALSE(exists(target / "picture.png"));
    if (known) {
      EXPECT_FLOAT_EQ(read_pfm(target / "depth.pfm")(4, 2), 25 / 7.5f);
    }
  }
}

TEST_F(DepthOutput, UnstructuredViewsGetDepthAndTheirPictureInTheirOwnSize) {
  LightField light_field = small_field();
  light_field.kind = LightFieldKind::kUnstructured;
  light_field.cameras.resize(2);
  light_field.cameras[0].width = 4;
  light_field.cameras[0].height = 3;
  FloatMap disparity(5, 3, 1, 0.25f);
  disparity(1, 1) = 0;
  DepthFolder out(folder / "out", {}, {});
  out.describe(light_field);
  out.write_view(0, disparity, FloatMap(5, 3, 1, 1), {-1, 1}, true);
  out.commit("{}");
  for (const auto& place : {folder / "out", folder / "out" / "a"}) {
    const FloatMap depth = read_pfm(place / "depth.pfm");
    ASSERT_EQ(depth.width(), 4);
    EXPECT_EQ(depth(0, 0), 4);
    EXPECT_TRUE(std::isnan(depth(1, 1))) << "infinitely far";
    EXPECT_EQ(read_picture(place / "picture.png")(3, 2, 1), 77);
    EXPECT_EQ(read_picture(place / "picture.png").width(), 4);
  }
}

}  // namespace
}  // namespace gigaray
