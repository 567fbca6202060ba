// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/view_scene.h"

#include <zlib.h>

#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "gigaray/adapters/maps.h"
#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/masks.h"
#include "workflows_test.h"

namespace gigaray {
namespace {

using nlohmann::json;

class ViewSceneTest : public WorkflowsTest {
 protected:
  DepthScene& scene_of(const std::filesystem::path& place) {
    OpenedInput input = open_input({.path = place}, control);
    scene = std::make_unique<DepthScene>(
        input, std::make_shared<const Reconstruction>(compute_depth(input, {}, control)));
    return *scene;
  }
  json made(const ViewSceneRequest& request) {
    files.clear();
    return json::parse(view_scene(
        *scene, request,
        [&](const std::string& name, std::string bytes) {
          EXPECT_TRUE(files.emplace(name, std::move(bytes)).second) << name;
        },
        control));
  }

  std::unique_ptr<DepthScene> scene;
  std::map<std::string, std::string> files;
};

std::string unzipped(const std::string& packed, std::size_t size) {
  std::string bytes(size + 1, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 16 + MAX_WBITS), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = uInt(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = uInt(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.total_out, size);
  inflateEnd(&stream);
  bytes.resize(size);
  return bytes;
}

/// The codes of a map as the page reads them.
Image<std::uint16_t> codes_of(const std::string& packed, int width, int height) {
  Image<std::uint16_t> codes(width, height);
  const std::string bytes = unzipped(packed, 2 * codes.size());
  std::size_t i = 0;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u, ++i) {
      const auto high = std::uint8_t(bytes[i]), low = std::uint8_t(bytes[codes.size() + i]);
      codes(u, v) = std::uint16_t((high << 8 | low) + (u > 0 ? codes(u - 1, v) : 0));
    }
  return codes;
}

TEST_F(ViewSceneTest, CodesAreTheMapsToHalfAStep) {
  scene_of(grid());
  const json json = made({});
  ASSERT_EQ(json["views"].size(), 9u);
  const double least = json["value"]["min"], most = json["value"]["max"];
  const double step = (most - least) / 65534;
  for (const int view : scene->views()) {
    const auto& shown = json["views"][std::size_t(view)];
    EXPECT_FALSE(files.at(shown["image"]).empty());
    const FloatMap map = scene->disparity(view);
    const auto codes = codes_of(files.at(shown["maps"]["value"]), 93, 63);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const std::uint16_t code = codes.data()[i];
      ASSERT_EQ(code == 0, std::isnan(map.data()[i]));
      if (code > 0) {
        ASSERT_NEAR(least + (code - 1) * step, map.data()[i], 0.5001 * step);
      }
    }
  }
}

TEST_F(ViewSceneTest, AnIntervalOfCodesIsTheMaskBetweenTheirHalves) {
  scene_of(grid());
  const json json = made({.views = "centre"});
  const int view = scene->top_view();
  const auto codes = codes_of(files.at(json["views"][std::size_t(view)]["maps"]["value"]), 93, 63);
  const double least = json["value"]["min"], most = json["value"]["max"];
  const auto value = [&](double code) { return least + (code - 1) * (most - least) / 65534; };
  for (const auto& [far, near] :
       std::vector<std::pair<int, int>>{{20000, 50000}, {1, 65535}, {40000, 40700}}) {
    const SceneMasks masks(*scene,
                           {.between = MaskRequest::NearFar{value(near + 0.5), value(far - 0.5)},
                            .unit = "disparity"});
    const Mask mask = masks.view(view).mask;
    for (std::size_t i = 0; i < mask.size(); ++i)
      ASSERT_EQ(mask.data()[i], codes.data()[i] >= far && codes.data()[i] <= near) << far;
  }
}

TEST_F(ViewSceneTest, ShrunkPicturesKeepValuesOfTheFullOnes) {
  scene_of(walk());
  const json json = made({.views = "centre", .max_size = 40});
  const auto& shown = json["views"][std::size_t(scene->top_view())];
  const int width = shown["width"], height = shown["height"];
  EXPECT_EQ(width, 40);
  EXPECT_NEAR(double(json["scale"]), 40.0 / 93, 1e-12);
  EXPECT_EQ(json["kind"], "unstructured");
  const FloatMap map = scene->disparity(scene->top_view());
  const auto codes = codes_of(files.at(shown["maps"]["value"]), width, height);
  const double least = json["value"]["min"], most = json["value"]["max"];
  const float middle = map(int(20.5 * 93 / 40), int((10.5) * 63 / height));
  EXPECT_NEAR(least + (codes(20, 10) - 1) * (most - least) / 65534, middle, (most - least) / 65534);
  const Camera& full = scene->rig().camera(scene->top_view());
  EXPECT_NEAR(double(shown["camera"]["focal"][0]), full.focal_u * 40 / 93, 1e-9);
}

TEST_F(ViewSceneTest, NineViewsThatStandApartHaveMapsUnlessOthersAreNamed) {
  SyntheticOptions options;
  options.scene = "planes";
  options.width = 48;
  options.height = 32;
  options.views_s = options.views_t = 5;
  write_synthetic_light_field(folder / "wide", options, {}, control);
  scene_of(folder / "wide");
  int with_maps = 0;
  const json all = made({});
  for (const auto& view : all["views"]) with_maps += !view["maps"].is_null();
  EXPECT_EQ(with_maps, 9);
  EXPECT_FALSE(all["views"][0]["maps"].is_null());   // a corner
  EXPECT_FALSE(all["views"][12]["maps"].is_null());  // the centre
  const json two = made({.views = "0,7"});
  EXPECT_FALSE(two["views"][7]["maps"].is_null());
  EXPECT_TRUE(two["views"][12]["maps"].is_null());
}

TEST_F(ViewSceneTest, ErrorsAndAnotherResultAreMapsOfTheSameCode) {
  const std::filesystem::path place = grid();
  scene_of(place);
  OpenedInput input = open_input({.path = place}, control);
  DepthRequest coarse;
  coarse.options = paper_options();
  const auto other = std::make_shared<DepthScene>(
      input, std::make_shared<const Reconstruction>(compute_depth(input, coarse, control)));
  const json json = made({.views = "centre", .compare = other, .truth = place});
  const std::size_t view = std::size_t(scene->top_view());
  const auto errors = codes_of(files.at(json["views"][view]["maps"]["error"]), 93, 63);
  const FloatMap truth = read_float_map(place / "truth.pfm");
  const double least = json["error"]["min"], most = json["error"]["max"];
  const FloatMap map = scene->disparity(int(view));
  EXPECT_NEAR(least + (errors(46, 31) - 1) * (most - least) / 65534, map(46, 31) - truth(46, 31),
              (most - least) / 65534);
  const std::string name = json["views"][view]["name"];
  EXPECT_TRUE(files.contains(json["compare"]["maps"][name]["value"]));
}

TEST_F(ViewSceneTest, ErrorsOfPhotographsAreThoseOfInverseDepth) {
  const std::filesystem::path place = walk();
  scene_of(place);
  const json json = made({.views = "centre", .truth = place});
  const auto& view = json["views"][std::size_t(scene->top_view())];
  const auto errors = codes_of(files.at(view["maps"]["error"]), 93, 63);
  const FloatMap depth =
      read_float_map(place / "truth" / (view["name"].get<std::string>() + ".pfm"));
  const FloatMap map = scene->disparity(scene->top_view());
  const double least = json["error"]["min"], step = (double(json["error"]["max"]) - least) / 65534;
  EXPECT_NEAR(least + (errors(46, 31) - 1) * step, map(46, 31) - 1 / depth(46, 31), step);
}

TEST_F(ViewSceneTest, OfALightFieldAloneHasNoMaps) {
  const OpenedInput input = open_input({.path = grid()}, control);
  const json json = json::parse(view_scene(
      input.light_field, "grid", {}, [](const std::string&, std::string) {}, control));
  EXPECT_EQ(json["title"], "grid");
  for (const auto& view : json["views"]) EXPECT_TRUE(view["maps"].is_null());
  refusal(ErrorCode::kInvalidArgument, [&] {
    view_scene(
        input.light_field, "grid", {.views = "0"}, [](const std::string&, std::string) {}, control);
  });
}

TEST_F(ViewSceneTest, WhatCannotBeShownIsNamed) {
  scene_of(grid());
  const auto take = [](const std::string&, std::string) {};
  EXPECT_NE(refusal(ErrorCode::kInvalidArgument,
                    [&] { view_scene(*scene, {.views = "nobody"}, take, control); })
                .find("nobody"),
            std::string::npos);
  EXPECT_NE(refusal(ErrorCode::kInvalidArgument,
                    [&] { view_scene(*scene, {.jpeg_quality = 0}, take, control); })
                .find("`jpeg_quality`"),
            std::string::npos);
  EXPECT_NE(refusal(ErrorCode::kIo,
                    [&] { view_scene(*scene, {.cloud = folder / "no.ply"}, take, control); })
                .find("no.ply"),
            std::string::npos);
}

}  // namespace
}  // namespace gigaray
