// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/colmap_maps.h"

#include <cmath>
#include <limits>

#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

class ColmapMaps : public AdaptersTest {};

TEST_F(ColmapMaps, DepthIsReadBackAndNoEstimateIsZeroInTheFile) {
  FloatMap depth(7, 5);
  for (std::size_t i = 0; i < depth.size(); ++i) depth.data()[i] = 0.5f + 0.3f * float(i);
  depth(3, 2) = kNoEstimate;
  const auto path = colmap_depth_map_path(folder, "left/a b.png");
  EXPECT_EQ(path, folder / "stereo" / "depth_maps" / "left" / "a b.png.geometric.bin");
  write_colmap_depth_map(path, depth);
  const FloatMap again = read_colmap_depth_map(path);
  ASSERT_EQ(again.width(), 7);
  ASSERT_EQ(again.height(), 5);
  EXPECT_TRUE(std::isnan(again(3, 2)));
  EXPECT_EQ(again(4, 2), depth(4, 2));
  EXPECT_EQ(again(0, 4), depth(0, 4));
  const std::string bytes = read("stereo/depth_maps/left/a b.png.geometric.bin");
  EXPECT_EQ(bytes.substr(0, 6), "7&5&1&");
  EXPECT_EQ(bytes.size(), 6 + 4 * 35);
  // 0.5f in little endian is the first pixel, NaN has become 0.
  EXPECT_EQ(bytes.substr(6, 4), std::string("\0\0\0\x3f", 4));
  EXPECT_EQ(bytes.substr(6 + 4 * 17, 4), std::string(4, '\0'));
}

TEST_F(ColmapMaps, WhatIsNoDepthBecomesNoEstimate) {
  FloatMap depth(3, 1, 1, 1.0f);
  depth(0, 0) = -1;
  depth(1, 0) = std::numeric_limits<float>::infinity();
  write_colmap_depth_map(folder / "a.bin", depth);
  const FloatMap again = read_colmap_depth_map(folder / "a.bin");
  EXPECT_TRUE(std::isnan(again(0, 0)));
  EXPECT_TRUE(std::isnan(again(1, 0)));
  EXPECT_EQ(again(2, 0), 1);
}

TEST_F(ColmapMaps, DamagedFilesAreNamed) {
  const auto refused = [&](const std::string& bytes, const std::string& word) {
    write("a.bin", bytes);
    expect_error(ErrorCode::kBadInput, word, [&] { read_colmap_depth_map(folder / "a.bin"); });
    expect_error(ErrorCode::kBadInput, "a.bin", [&] { read_colmap_depth_map(folder / "a.bin"); });
  };
  refused("", "size");
  refused("7&5", "size");
  refused("7&5&x&", "size");
  refused("0&5&1&", "size");
  refused("7.5&5&1&", "size");
  refused("nan&5&1&", "size");
  refused("99999999&5&1&", "size");
  refused("2&1&3&" + std::string(24, 'x'), "3 channels");
  refused("2&1&1&" + std::string(7, 'x'), "cut short");
  refused("1000000&1000000&1&" + std::string(7, 'x'), "cut short");
  refused("2&1&1&" + std::string(9, 'x'), "too long");
  expect_error(ErrorCode::kIo, "nowhere", [&] { read_colmap_depth_map(folder / "nowhere"); });
}

}  // namespace
}  // namespace gigaray
