// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What tells photographs from anywhere from a row; pictures that are shrunk.
#include "gigaray/adapters/photographs.h"

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"
#include "adapters/light_field_files.h"
#include "adapters/textured_planes.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/shrunk.h"
#include "support/cameras.h"

namespace gigaray {
namespace {

class PlainPhotographs : public AdaptersTest {
 protected:
  /// Pictures of cameras that step by `right` and `down`, scene units.
  void photograph(double right, double down, int count = 4) const {
    for (int i = 0; i < count; ++i) {
      Camera camera = testing_support::centred_camera(400, 300, 380);
      camera.translation = {-right * i, -down * i, 0};
      save("p" + std::to_string(i) + ".png", textured_planes(camera));
    }
  }
  std::optional<double> across() const {
    return displacement_across_rows(open_light_field(folder), RunControl());
  }
};

TEST_F(PlainPhotographs, ARowMovesAlongItsRowsAlone) {
  photograph(0.1, 0);
  EXPECT_EQ(why_no_series(folder), "");
  const auto px = across();
  ASSERT_TRUE(px);
  EXPECT_LT(*px, 0.5);
}

TEST_F(PlainPhotographs, AColumnIsARowToo) {
  photograph(0, 0.1);
  const auto px = across();
  ASSERT_TRUE(px);
  EXPECT_LT(*px, 0.5);
}

TEST_F(PlainPhotographs, AWalkMovesAcrossThem) {
  photograph(0.1, 0.06);
  const auto px = across();
  ASSERT_TRUE(px);
  EXPECT_GT(*px, kMostAcrossRows);
}

TEST_F(PlainPhotographs, NamesAndSizesSayMuch) {
  save("a.png");
  save("b.png");
  EXPECT_NE(why_no_series(folder), "");
  EXPECT_TRUE(is_plain_folder(folder, {}));
  write_colmap_model(folder / "sparse", colmap_scene(), ColmapFormat::kText);
  EXPECT_FALSE(is_plain_folder(folder, {}));
}

TEST_F(PlainPhotographs, UprightOnesAndOnesOnTheirSideAreNoRow) {
  for (int i = 0; i < 4; ++i)
    save("p" + std::to_string(i) + ".png",
         picture(CV_8UC3, i == 2 ? kHeight : kWidth, i == 2 ? kWidth : kHeight));
  EXPECT_NE(why_no_series(folder), "");
}

TEST_F(PlainPhotographs, EveryPictureTwiceOrTwoSeriesAreSaid) {
  for (const std::string i : {"1", "2", "3"}) {
    save("p" + i + ".png");
    save("P" + i + ".jpg");
  }
  EXPECT_NE(why_twice(folder).find("P1.jpg and p1.png"), std::string::npos) << why_twice(folder);
  for (const std::string i : {"1", "2", "3"})
    std::filesystem::rename(folder / ("P" + i + ".jpg"), folder / ("q" + i + ".jpg"));
  EXPECT_NE(why_twice(folder).find("more than one series"), std::string::npos);
  for (const std::string i : {"1", "2", "3"}) std::filesystem::remove(folder / ("q" + i + ".jpg"));
  EXPECT_EQ(why_twice(folder), "");
}

TEST_F(PlainPhotographs, NamesWithoutNumbersMayBeThereTwice) {
  for (const std::string name : {"door", "wall", "tree"}) {
    save(name + ".png");
    save(name + ".jpg");
  }
  EXPECT_NE(why_twice(folder).find("twice"), std::string::npos);
  // Photographs of several sources are no series.
  std::filesystem::remove_all(folder);
  for (const char* name : {"a1.png", "b2.png", "c3.png", "d.png", "c3.jpg"}) save(name);
  EXPECT_EQ(why_twice(folder), "");
}

TEST_F(PlainPhotographs, FilesThatLookLikeCamerasAreNamed) {
  const auto note = [&](const std::filesystem::path& input) {
    for (const std::string& note : open_light_field(input).notes)
      if (note.find("looks like cameras") != std::string::npos) return note;
    return std::string();
  };
  for (const char* name : {"in/images/p1.png", "in/images/p2.png"}) save(name);
  const std::filesystem::path images = folder / "in/images";
  EXPECT_EQ(note(images), "");
  for (const char* name : {"transforms.json", "Transforms_val.json", "cameras.txt", "images.txt",
                           "calib.txt", "poses_bounds.npy", "x_par.txt", "p1.png.camera",
                           "p1_cam.txt", "cameras_sphere.npz", "cameras.json", "sfm_data.json",
                           "Poses.txt", "camera_intrinsics.yaml", "bundle.out", "my.nvm"})
    for (const std::filesystem::path& place : {folder / "in", images}) {
      std::ofstream(place / name) << "?";
      // In the folder of the pictures some are taken for what they claim to be.
      if (place != images || std::string(name).starts_with("c")) {
        EXPECT_NE(note(images).find(name), std::string::npos) << place / name;
      }
      std::filesystem::remove(place / name);
    }
  write("in/notes.txt", "?");
  EXPECT_EQ(note(images), "");
  std::filesystem::create_directory(folder / "in/cams");
  EXPECT_EQ(note(images), "") << "an empty folder";
  write("in/cams/0000.txt", "?");
  EXPECT_NE(note(images).find("cams"), std::string::npos);
}

TEST_F(PlainPhotographs, CamerasThatAreUsedAreNotNamed) {
  const ColmapModel model = colmap_scene();
  for (const auto& image : model.images) save("images/" + image.name);
  write_colmap_model(folder / "sparse/0", model, ColmapFormat::kText);
  EXPECT_TRUE(open_light_field(folder).notes.empty());
  // A second statement of them is.
  write("poses_bounds.npy", "?");
  const auto notes = open_light_field(folder).notes;
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("poses_bounds.npy"), std::string::npos);
}

TEST(Shrunk, CamerasAndDisparitiesFollow) {
  LightField row = planes_seen_from({{"a", -0.5, 0}, {"b", 0.5, 0}}, 96, 64);
  row.declared_range = DisparityRange{-1, 2};
  row.rig.focal_px = 120;
  const LightField small = shrunk(row, 48);
  EXPECT_EQ(small.width, 48);
  EXPECT_EQ(small.height, 32);
  EXPECT_DOUBLE_EQ(*small.rig.focal_px, 60);
  EXPECT_EQ(*small.declared_range, (DisparityRange{-0.5, 1}));
  const Image<std::uint16_t> full = row.pixels->read(1), half = small.pixels->read(1);
  for (int c = 0; c < 3; ++c) {
    const double mean =
        (full(20, 10, c) + full(21, 10, c) + full(20, 11, c) + full(21, 11, c)) / 4.0;
    EXPECT_NEAR(half(10, 5, c), mean, 1);
  }
  EXPECT_EQ(shrunk(row, 96).width, 96);
  testing_support::expect_error(ErrorCode::kInvalidArgument, {"15"}, [&] { shrunk(row, 15); });
}

TEST_F(PlainPhotographs, ShrunkCamerasSeeTheSamePoints) {
  const ColmapModel model = colmap_scene();
  for (const auto& image : model.images) save("images/" + image.name, picture(CV_8UC3, 46, 34));
  ColmapModel large = model;
  large.cameras[7] = {"PINHOLE", 46, 34, {60, 62, 23, 17}};
  write_colmap_model(folder / "sparse", large, ColmapFormat::kText);
  const LightField full = open_light_field(folder), small = shrunk(full, 23);
  EXPECT_EQ(small.width, 23);
  for (int i = 0; i < 3; ++i)
    for (const auto& point : model.points) {
      const Eigen::Vector3d at = full.cameras[i].project(point.position);
      const Eigen::Vector3d then = small.cameras[i].project(point.position);
      // The middle of a block of 2 × 2 pixels is the middle of one.
      EXPECT_NEAR(then.x(), (at.x() - 0.5) / 2, 1e-9);
      EXPECT_NEAR(then.y(), (at.y() - 0.5) / 2, 1e-9);
    }
}

}  // namespace
}  // namespace gigaray
