// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Points of the scene beside its cameras give the range of depths.
#include <nlohmann/json.hpp>

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"
#include "gigaray/adapters/pose_convention.h"
#include "output/ply_points.h"

namespace gigaray {
namespace {

using nlohmann::json;

void expect_cut_short(const std::string& bytes) {
  testing_support::expect_error(ErrorCode::kBadInput, {"cut short"},
                                [&] { parse_ply_points(bytes, "p"); });
}

class PointsBeside : public AdaptersTest {
 protected:
  PointsBeside() {
    for (const ColmapModel::Image& image : model.images) save("images/" + image.name);
    write_colmap_model(folder / "exact/sparse/0", model, ColmapFormat::kText);
    OpenOptions options;
    options.images = folder / "images";
    exact = open_light_field(folder / "exact", options);
    model.points.clear();
    for (ColmapModel::Image& image : model.images) image.features.clear();
  }

  std::string ply(double shift = 0) const {
    const ColmapModel full = colmap_scene();
    std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                       std::to_string(full.points.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    for (const ColmapModel::Point& point : full.points)
      text += std::to_string(point.position.x()) + " " + std::to_string(point.position.y()) + " " +
              std::to_string(point.position.z() + shift) + "\n";
    return text;
  }
  json transforms() const {
    json root{{"w", 23}, {"h", 17}, {"fl_x", 30}, {"fl_y", 31}, {"cx", 11.5}, {"cy", 8.5}};
    for (const ColmapModel::Image& image : model.images) {
      const StatedPose stated =
          state_pose({image.rotation.toRotationMatrix(), image.translation}, {"RUB", false});
      json matrix = json::array();
      for (int row = 0; row < 3; ++row)
        matrix.push_back({stated(row, 0), stated(row, 1), stated(row, 2), stated(row, 3)});
      root["frames"].push_back(
          {{"file_path", "images/" + image.name}, {"transform_matrix", matrix}});
    }
    return root;
  }
  void expect_exact(const LightField& light_field) const {
    for (int i = 0; i < light_field.num_views(); ++i) {
      ASSERT_TRUE(light_field.cameras[i].inverse_depth) << i;
      EXPECT_NEAR(light_field.cameras[i].inverse_depth->min, exact.cameras[i].inverse_depth->min,
                  1e-4);
      EXPECT_NEAR(light_field.cameras[i].inverse_depth->max, exact.cameras[i].inverse_depth->max,
                  1e-4);
    }
    EXPECT_NE(light_field.notes.back().find("depths are searched where the 40 points of"),
              std::string::npos);
  }

  ColmapModel model = colmap_scene();
  LightField exact;
};

TEST_F(PointsBeside, TheRangeIsThatOfTheStatedFile) {
  json root = transforms();
  root["ply_file_path"] = "cloud/mine.ply";
  write("transforms.json", root.dump());
  EXPECT_FALSE(open_light_field(folder).cameras[0].inverse_depth);
  std::filesystem::create_directory(folder / "cloud");
  write("cloud/mine.ply", ply());
  expect_exact(open_light_field(folder));
}

TEST_F(PointsBeside, UsualNamesAreFoundOfAnyFormat) {
  write("transforms.json", transforms().dump());
  write("Sparse_PC.ply", ply());
  expect_exact(open_light_field(folder));
  std::filesystem::remove(folder / "transforms.json");
  write_colmap_model(folder / "sparse/0", model, ColmapFormat::kText);
  std::filesystem::remove(folder / "sparse/0/points3D.txt");
  EXPECT_FALSE(open_light_field(folder).cameras[0].inverse_depth);
  std::filesystem::rename(folder / "Sparse_PC.ply", folder / "sparse/0/points3D.ply");
  expect_exact(open_light_field(folder));
}

TEST_F(PointsBeside, PointsOfAnotherPlaceAreNotUsed) {
  write("transforms.json", transforms().dump());
  write("sparse_pc.ply", ply(-50));
  const LightField light_field = open_light_field(folder);
  EXPECT_FALSE(light_field.cameras[0].inverse_depth);
  EXPECT_NE(light_field.notes.back().find("not where the cameras look"), std::string::npos);
}

TEST_F(PointsBeside, ADamagedFileIsNamedAndNotUsed) {
  write("transforms.json", transforms().dump());
  const std::string text = ply();
  std::string wrong = text;
  wrong.replace(wrong.find("vertex 40"), 9, "vertex 99");
  for (const std::string& damaged : {text.substr(0, 60), text.substr(0, text.size() / 2), wrong,
                                     std::string("no ply"), std::string()}) {
    write("sparse_pc.ply", damaged);
    const LightField light_field = open_light_field(folder);
    EXPECT_FALSE(light_field.cameras[0].inverse_depth);
    EXPECT_NE(light_field.notes.back().find("sparse_pc.ply"), std::string::npos);
    EXPECT_NE(light_field.notes.back().find("not used"), std::string::npos);
  }
}

TEST(PlyPoints, EveryTypeAndByteOrderIsRead) {
  const std::string head =
      "element vertex 2\nproperty uchar red\nproperty double x\n"
      "property float y\nproperty short z\nelement face 0\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::vector<Eigen::Vector3d> wanted{{1.5, -2.25, 300}, {1e6 + 0.125, 4, -5}};
  for (const bool big : {false, true}) {
    std::string bytes =
        "ply\r\nformat binary_" + std::string(big ? "big" : "little") + "_endian 1.0\n" + head;
    const auto add = [&](auto value) {
      std::string own(reinterpret_cast<const char*>(&value), sizeof value);
      if (big) std::reverse(own.begin(), own.end());
      bytes += own;
    };
    for (const Eigen::Vector3d& point : wanted) {
      add(std::uint8_t(7));
      add(point.x());
      add(float(point.y()));
      add(std::int16_t(point.z()));
    }
    EXPECT_EQ(parse_ply_points(bytes, "p"), wanted);
    bytes.pop_back();
    expect_cut_short(bytes);
  }
  EXPECT_EQ(
      parse_ply_points("ply\nformat ascii 1.0\n" + head + "7 1.5 -2.25 300\n9 nan 4 -5\n", "p"),
      std::vector<Eigen::Vector3d>{wanted[0]});
}

}  // namespace
}  // namespace gigaray
