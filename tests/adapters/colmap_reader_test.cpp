// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"
#include "formats/view_names.h"
#include "gigaray/adapters/registry.h"

namespace gigaray {
namespace {

class ColmapWorkspace : public AdaptersTest {
 protected:
  void save_pictures(const std::string& below, const ColmapModel& model = colmap_scene()) const {
    for (const ColmapModel::Image& image : model.images) save(below + image.name);
  }
  void save_model(const std::string& below, const ColmapModel& model = colmap_scene(),
                  ColmapFormat format = ColmapFormat::kBinary) const {
    write_colmap_model(folder / below, model, format);
  }
  static bool has_note(const LightField& light_field, const std::string& word) {
    for (const std::string& note : light_field.notes)
      if (note.find(word) != std::string::npos) return true;
    return false;
  }
};

TEST_F(ColmapWorkspace, KnownPointIsSeenInItsPixel) {
  const ColmapModel model = colmap_scene();
  save_pictures("images/");
  save_model("sparse/0");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.format, "COLMAP workspace");
  EXPECT_EQ(light_field.kind, LightFieldKind::kUnstructured);
  ASSERT_EQ(light_field.num_views(), 3);
  EXPECT_TRUE(light_field.notes.empty());
  EXPECT_TRUE(light_field.rig.unit.empty());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(light_field.views[i].name, "v" + std::to_string(i));
    const Camera& camera = light_field.cameras[i];
    EXPECT_LT((camera.position() - Eigen::Vector3d(0.3 * i, 0, 0)).norm(), 1e-12);
    for (std::size_t k = 0; k < model.points.size(); ++k) {
      const Eigen::Vector3d at = camera.project(model.points[k].position);
      const ColmapModel::Feature& feature = model.images[i].features[k];
      EXPECT_NEAR(at.x(), feature.x - 0.5, 1e-9);
      EXPECT_NEAR(at.y(), feature.y - 0.5, 1e-9);
    }
  }
  EXPECT_EQ(read_view(light_field, 1).width(), kWidth);
}

TEST_F(ColmapWorkspace, RangeOfDepthsIsThatOfThePointsThatAViewSees) {
  ColmapModel model = colmap_scene(3, 60);
  // Two rays that meet by chance, and a match that is far off.
  for (int k : {3, 4}) model.points[k].position.z() = 0.5;
  model.points[3].track.resize(2);
  model.points[4].error = 50;
  save_pictures("images/");
  save_model("sparse/0", model);
  const LightField light_field = open_light_field(folder);
  for (const Camera& camera : light_field.cameras) {
    ASSERT_TRUE(camera.inverse_depth.has_value());
    // Points at 4 … 8, widened by a fifth of their span at both ends.
    EXPECT_NEAR(camera.inverse_depth->max, 0.275, 0.005);
    EXPECT_NEAR(camera.inverse_depth->min, 0.1, 0.005);
  }
}

TEST_F(ColmapWorkspace, ViewWithoutPointsOfItsOwnTakesThoseBeforeIt) {
  ColmapModel model = colmap_scene();
  for (ColmapModel::Point& point : model.points) point.track.pop_back();
  model.images.back().features.clear();
  save_pictures("images/");
  save_model("sparse/0", model);
  EXPECT_NEAR(1 / open_light_field(folder).cameras[2].inverse_depth.value().max, 4, 0.4);
  model.points.clear();
  save_model("sparse/0", model);
  EXPECT_FALSE(open_light_field(folder).cameras[2].inverse_depth.has_value());
}

TEST_F(ColmapWorkspace, IsFoundWhereverItLies) {
  const auto opens = [&](const std::string& model, const std::string& pictures,
                         const std::string& input, const std::string& images = "") {
    SCOPED_TRACE(model + " " + pictures + " " + input);
    save_model("w/" + model);
    save_pictures(pictures);
    OpenOptions options;
    if (!images.empty()) options.images = folder / images;
    EXPECT_EQ(open_light_field(folder / input, options).num_views(), 3);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      std::filesystem::remove_all(entry.path());
  };
  opens("sparse/0", "w/images/", "w");
  opens("sparse/0", "w/", "w");
  opens("sparse", "w/images/", "w");
  opens("sparse", "w/", "w");
  opens("dense/sparse", "w/dense/images/", "w");
  opens("dense/sparse", "w/dense/images/", "w/dense");
  opens("", "w/images/", "w");
  opens("", "w/", "w");
  opens("sparse/0", "w/images/", "w/sparse/0");
  opens("sparse/0", "w/", "w/sparse/0/");
  opens("sparse/4", "w/images/", "w/sparse");
  opens("sparse/0", "elsewhere/", "w", "elsewhere");
}

TEST_F(ColmapWorkspace, LargestOfSeveralModelsIsTaken) {
  save_pictures("images/", colmap_scene(5));
  save_model("sparse/0", colmap_scene(2));
  save_model("sparse/1", colmap_scene(5));
  save_model("sparse/10", colmap_scene(3));
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.num_views(), 5);
  EXPECT_TRUE(has_note(light_field, "0 has 2, 1 has 5, 10 has 3"));
  EXPECT_EQ(open_light_field(folder / "sparse" / "10").num_views(), 3);
  cut_short("sparse/1/images.bin", 0.5);
  const LightField next = open_light_field(folder);
  EXPECT_EQ(next.num_views(), 3);
  EXPECT_TRUE(has_note(next, "left out"));
  cut_short("sparse/0/images.bin", 0.5);
  cut_short("sparse/10/images.bin", 0.5);
  expect_bad_input("images.bin");
}

TEST_F(ColmapWorkspace, NamesOfViewsAreUniqueAndNoPaths) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(view_names({"left/a.png", "b.jpg"}), (Names{"a", "b"}));
  EXPECT_EQ(view_names({"left/a.png", "right/a.png"}), (Names{"left_a", "right_a"}));
  EXPECT_EQ(view_names({"a.png", "a.jpg"}), (Names{"a.png", "a.jpg"}));
  EXPECT_EQ(view_names({"a/b.png", "a_b.png", "c/b.png"}),
            (Names{"a_b.png", "a_b.png_", "c_b.png"}));
  for (const std::string& name : view_names({"../x/a.png", "../y/a.png", "a\\b.png", ".h.png"})) {
    EXPECT_EQ(name.find_first_of("/\\"), std::string::npos) << name;
    EXPECT_NE(name.front(), '.') << name;
  }
}

TEST_F(ColmapWorkspace, PicturesInFoldersKeepTheirPlaces) {
  ColmapModel model = colmap_scene();
  model.images[0].name = "left/a.png";
  model.images[1].name = "right/a.png";
  model.images[2].name = "right/two words.png";
  save_pictures("images/", model);
  save_model("sparse/0", model, ColmapFormat::kText);
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.views[0].name, "left_a");
  EXPECT_EQ(light_field.views[2].name, "right_two words");
}

TEST_F(ColmapWorkspace, MasksAreFoundUnderBothNames) {
  save_pictures("images/");
  save_model("sparse/0");
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  mask.at<std::uint8_t>(2, 3) = 0;
  save("masks/v0.png.png", mask);
  save("masks/v1.png", mask);
  OpenOptions options;
  options.masks = folder / "masks";
  const LightField light_field = open_light_field(folder, options);
  ASSERT_TRUE(light_field.pixels->has_mask());
  EXPECT_EQ(read_view(light_field, 0)(3, 2, 3), 0);
  EXPECT_EQ(read_view(light_field, 1)(3, 2, 3), 0);
  EXPECT_EQ(read_view(light_field, 1)(4, 2, 3), 255);
  EXPECT_EQ(read_view(light_field, 2)(3, 2, 3), 255);
  EXPECT_TRUE(has_note(light_field, "1 of 3 pictures have no mask"));
  options.masks = folder / "nowhere";
  expect_bad_input("nowhere", options);
}

TEST_F(ColmapWorkspace, MissingPicturesAreCounted) {
  save_model("sparse/0");
  expect_bad_input("none of the 3 pictures");
  expect_bad_input("OpenOptions::images");
  save("images/v0.png");
  expect_bad_input("v1.png: is missing, one of 2 of the 3 pictures");
  OpenOptions options;
  options.images = folder / "nowhere";
  expect_bad_input("nowhere", options);
}

TEST_F(ColmapWorkspace, TooFewImagesAreRefused) {
  save_pictures("images/");
  ColmapModel model = colmap_scene(1);
  save_model("sparse/0", model);
  expect_bad_input("only one image");
  model.images.clear();
  model.points.clear();
  save_model("sparse/0", model);
  expect_bad_input("no image is registered");
}

TEST_F(ColmapWorkspace, PartOfAModelIsNamed) {
  std::filesystem::create_directories(folder / "sparse/0");
  write("sparse/0/cameras.bin", "x");
  expect_bad_input("images.bin");
  save_model("sparse/0");
  cut_short("sparse/0/cameras.bin", 0.9);
  save_pictures("images/");
  expect_bad_input("cameras.bin");
}

TEST_F(ColmapWorkspace, RigsAreIgnoredWithANote) {
  save_pictures("images/");
  save_model("sparse/0");
  write("sparse/0/rigs.bin", "x");
  EXPECT_TRUE(has_note(open_light_field(folder), "rigs"));
}

TEST_F(ColmapWorkspace, OptionsThatDoNotGoWithItAreRefused) {
  save_pictures("images/");
  save_model("sparse/0");
  OpenOptions options;
  options.direction = Travel::kLeft;
  expect_error(ErrorCode::kInvalidArgument, "COLMAP", [&] { open_light_field(folder, options); });
  std::filesystem::remove_all(folder / "sparse");
  options = {};
  options.masks = folder;
  expect_error(ErrorCode::kBadInput, "holds no mask of any picture",
               [&] { open_light_field(folder / "images", options); });
  options = {};
  options.images = folder;
  expect_error(ErrorCode::kInvalidArgument, "OpenOptions::images",
               [&] { open_light_field(folder / "images", options); });
}

TEST_F(ColmapWorkspace, DamagedPictureIsNamedWhenItIsRead) {
  save_pictures("images/");
  save_model("sparse/0");
  const LightField light_field = open_light_field(folder);
  cut_short("images/v1.png", 0.6);
  expect_error(ErrorCode::kBadInput, "v1.png", [&] { read_view(light_field, 1); });
}

}  // namespace
}  // namespace gigaray
