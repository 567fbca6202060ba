// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/colmap_maps.h"

#include <cmath>
#include <cstring>
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

TEST_F(ColmapMaps, NormalsOfAPlaneAreItsOwn) {
  Camera camera;
  camera.width = 23;
  camera.height = 17;
  camera.focal_u = 30;
  camera.focal_v = 31;
  camera.centre_u = 11;
  camera.centre_v = 8;
  // n · X = -1
  const Eigen::Vector3d normal = Eigen::Vector3d(0.2, -0.1, -0.3);
  FloatMap depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
      depth(u, v) = float(-1 / normal.dot(camera.back_project(u, v, 1)));
  depth(4, 5) = kNoEstimate;
  write_colmap_normal_map(folder / "n.bin", depth, camera);
  const std::string bytes = read("n.bin");
  const std::string head = "23&17&3&";
  ASSERT_EQ(bytes.substr(0, head.size()), head);
  ASSERT_EQ(bytes.size(), head.size() + 3 * 23 * 17 * sizeof(float));
  const auto value = [&](int u, int v, int c) {
    float x;
    std::memcpy(&x, bytes.data() + head.size() + sizeof(float) * ((c * 17 + v) * 23 + u), sizeof x);
    return x;
  };
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(value(12, 9, c), normal.normalized()[c], 1e-4);
    EXPECT_NEAR(value(0, 16, c), normal.normalized()[c], 1e-4);
    EXPECT_EQ(value(4, 5, c), 0);
    EXPECT_EQ(value(5, 5, c), 0);  // beside the hole
  }
}

}  // namespace
}  // namespace gigaray
