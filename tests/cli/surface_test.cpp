// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray cloud` and `gigaray mesh` on a scene with exact truth.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class SurfaceCommands : public ProgramTest {
 protected:
  SurfaceCommands() {
    EXPECT_EQ(run("synth planes -o made --samples 2 --views 5 --width 64 --height 49").exit_code,
              0);
    EXPECT_EQ(run("depth made -o depth").exit_code, 0);
  }
  void expect_refusal(const std::string& command, int exit_code, const std::string& word) {
    const Result result = run(command);
    EXPECT_EQ(result.exit_code, exit_code) << command << "\n" << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
  }
  /// Numbers of elements in the header of a PLY file.
  std::size_t elements(const std::string& file, const std::string& element) {
    const std::string text = text_of(file);
    const std::string key = "element " + element + " ";
    const std::size_t at = text.find(key);
    return at == std::string::npos ? 0 : std::stoul(text.substr(at + key.size()));
  }
  void replace_depth(float value) {
    for (const auto& entry : fs::directory_iterator(folder / "depth"))
      if (entry.is_directory()) {
        FloatMap map = read_pfm(entry.path() / "disparity.pfm");
        std::fill(map.begin(), map.end(), value);
        write_pfm(entry.path() / "disparity.pfm", map);
      }
  }
};

TEST_F(SurfaceCommands, CloudIsAPlyFileOfTheScene) {
  const Result result = run("cloud depth -o scene.ply");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("unconfirmed"), std::string::npos) << result.out;
  const std::size_t count = elements("scene.ply", "vertex");
  ASSERT_GT(count, 1000u);
  const std::string text = text_of("scene.ply");
  const std::size_t body = text.find("end_header\n") + 11;
  EXPECT_EQ(text.size() - body, count * 35);
  // Points lie within the depths that the maps have.
  const FloatMap depth = read_pfm(folder / "depth/depth.pfm");
  const auto [least, most] = std::minmax_element(depth.begin(), depth.end());
  for (std::size_t i = 0; i < count; ++i) {
    float z = 0;
    std::memcpy(&z, text.data() + body + i * 35 + 8, 4);
    ASSERT_GT(z, 0.8f * *least);
    ASSERT_LT(z, 1.2f * *most);
  }
  const json about = json::parse(run("cloud depth -o again.ply --json").out);
  EXPECT_EQ(about.at("points"), count);
  EXPECT_EQ(text_of("again.ply"), text);
  const json& filters = about.at("filters");
  EXPECT_EQ(filters.at("pixels"), 5 * 64 * 49);
  EXPECT_EQ(filters.at("plain_ground"), 0);
}

TEST_F(SurfaceCommands, LargerCubesGiveFewerPoints) {
  const json fine = json::parse(run("cloud depth -o a.ply --json").out);
  const double voxel = fine.at("voxel");
  const json coarse =
      json::parse(run("cloud depth -o b.ply --json --voxel " + std::to_string(4 * voxel)).out);
  EXPECT_LT(coarse.at("points").get<int>(), 0.3 * fine.at("points").get<int>());
}

TEST_F(SurfaceCommands, MeshOfEveryMethodAndFormat) {
  for (const std::string method : {"grid", "poisson", "front"}) {
    const Result result = run("mesh depth --json -o scene.ply --method " + method);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json mesh = json::parse(result.out).at("mesh");
    EXPECT_GT(mesh.at("faces"), 500) << method;
    EXPECT_EQ(elements("scene.ply", "vertex"), mesh.at("vertices"));
    EXPECT_EQ(elements("scene.ply", "face"), mesh.at("faces"));
  }
  for (const std::string name : {"scene.obj", "scene.glb", "scene.stl"})
    EXPECT_EQ(run("mesh depth -o " + name).exit_code, 0);
  EXPECT_EQ(text_of("scene.glb").substr(0, 4), "glTF");
  EXPECT_EQ(text_of("scene.obj").find("\nv ") != std::string::npos, true);
  std::uint32_t triangles = 0;
  const std::string stl = text_of("scene.stl");
  std::memcpy(&triangles, stl.data() + 80, 4);
  EXPECT_EQ(stl.size(), 84 + 50 * std::size_t(triangles));
}

TEST_F(SurfaceCommands, TextureIsInTheGlbOrBesideTheObj) {
  const Result glb = run("mesh depth --texture --json -o scene.glb");
  ASSERT_EQ(glb.exit_code, 0) << glb.err;
  const json texture = json::parse(glb.out).at("texture");
  EXPECT_GT(texture.at("views"), 0);
  EXPECT_GT(texture.at("charts"), 0);
  EXPECT_EQ(texture.at("scale"), 1);
  EXPECT_LT(texture.at("area_unseen"), 0.05);
  EXPECT_NE(text_of("scene.glb").find("baseColorTexture"), std::string::npos);
  const Result obj = run("mesh depth --texture --texture-size 64 --method poisson -o scene.obj");
  ASSERT_EQ(obj.exit_code, 0) << obj.err;
  EXPECT_NE(obj.out.find("texture  "), std::string::npos) << obj.out;
  EXPECT_NE(text_of("scene.obj").find("mtllib scene.mtl"), std::string::npos);
  EXPECT_NE(text_of("scene.mtl").find("map_Kd scene.jpg"), std::string::npos);
  EXPECT_EQ(text_of("scene.jpg").substr(0, 3), "\xff\xd8\xff");
  EXPECT_EQ(run("mesh depth --texture -o scene.obj").exit_code, 0);  // in place of its own files
}

TEST_F(SurfaceCommands, WhatHasNoTextureIsOneLine) {
  expect_refusal("mesh depth --texture -o a.ply", 2, "--texture is written as .glb or .obj");
  expect_refusal("mesh depth --texture -o a.stl", 2, "--texture is written as .glb or .obj");
  expect_refusal("mesh depth --texture-size 512 -o a.glb", 2, "--texture");
  expect_refusal("mesh depth --texture --texture-size 8 -o a.glb", 2, "--texture-size");
  fs::rename(folder / "made", folder / "moved");
  expect_refusal("mesh depth --texture -o a.obj", 1, "--input");
  for (const char* name : {"a.glb", "a.obj", "a.mtl", "a.jpg"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  EXPECT_EQ(run("mesh depth --texture --input moved -o a.glb").exit_code, 0);
}

TEST_F(SurfaceCommands, SimplifiedAndFilled) {
  const json mesh = json::parse(run("mesh depth --json -o a.ply --simplify 800 --fill 12").out);
  EXPECT_LE(mesh.at("mesh").at("faces"), 900);
  EXPECT_TRUE(mesh.contains("holes_filled"));
}

TEST_F(SurfaceCommands, AGrlFileWillDo) {
  ASSERT_EQ(run("encode made --depth depth -o made.grl").exit_code, 0);
  EXPECT_EQ(run("cloud made.grl -o a.ply").exit_code, 0);
  EXPECT_GT(elements("a.ply", "vertex"), 500u);
}

TEST_F(SurfaceCommands, WhatGivesNoSurfaceIsOneLine) {
  expect_refusal("cloud depth -o a.obj", 2, ".ply");
  expect_refusal("mesh depth -o a.fbx", 2, ".glb");
  expect_refusal("cloud nowhere -o a.ply", 1, "nowhere");
  expect_refusal("cloud depth -o a.ply --views 0,99", 2, "99");
  expect_refusal("mesh depth -o a.ply --method marching", 2, "marching");
  expect_refusal("mesh depth -o a.ply --least-faces 100000000", 1, "no surface is left");
  expect_refusal("cloud depth -o nofolder/a.ply", 1, "nofolder");
  replace_depth(kNoEstimate);
  expect_refusal("cloud depth -o a.ply", 1, "no view has an estimate");
  expect_refusal("mesh depth -o a.ply", 1, "no view has an estimate");
  fs::remove(folder / "depth/view_003/disparity.pfm");
  expect_refusal("cloud depth -o a.ply", 1, "view_003");
  EXPECT_FALSE(fs::exists(folder / "a.ply"));
}

TEST_F(SurfaceCommands, WallWithoutARangeOfItsOwn) {
  replace_depth(0.25f);
  EXPECT_EQ(run("cloud depth -o a.ply").exit_code, 0);
  EXPECT_EQ(run("mesh depth -o a.glb").exit_code, 0);
}

}  // namespace
}  // namespace gigaray
