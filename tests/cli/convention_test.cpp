// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Poses and places that the input states, held against the pictures.
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pose_convention.h"

namespace gigaray {
namespace {

using nlohmann::json;

class Convention : public ProgramTest {
 protected:
  static constexpr const char* kDepth = "depth walk -o out --views centre --hypotheses 64 ";

  Convention() {
    const Result result =
        run("synth garden -o walk --path walk --views 6 --width 160 --height 120 --samples 2");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    model = read_colmap_model(folder / "walk/sparse/0");
    std::filesystem::rename(folder / "walk/sparse", folder / "sparse");
  }

  /// transforms.json with matrices in another convention, of a scene whose z may be turned around.
  void state(const PoseConvention& convention, bool mirrored = false, double scale = 1) const {
    const Lens& lens = model.cameras.begin()->second;
    json root{{"w", lens.width},        {"h", lens.height},     {"fl_x", lens.params[0]},
              {"fl_y", lens.params[1]}, {"cx", lens.params[2]}, {"cy", lens.params[3]}};
    for (const ColmapModel::Image& image : model.images) {
      const CameraPose pose{image.rotation.toRotationMatrix(), image.translation, mirrored};
      StatedPose stated = state_pose(pose, convention);
      stated.leftCols<3>() *= scale;
      json matrix = json::array();
      for (int row = 0; row < 3; ++row)
        matrix.push_back({stated(row, 0), stated(row, 1), stated(row, 2), stated(row, 3)});
      matrix.push_back({0, 0, 0, 1});
      root["frames"].push_back(
          {{"file_path", "images/" + image.name}, {"transform_matrix", matrix}});
    }
    std::ofstream(folder / "walk/transforms.json") << root.dump();
  }

  /// Ends with one line that names the convention, after lines of progress.
  void expect_refused(const std::string& command, const std::string& convention) const {
    const Result result = run(command);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_NE(result.err.find("don't fit the pictures"), std::string::npos) << result.err;
    EXPECT_TRUE(result.err.ends_with("--convention " + convention + "\n")) << result.err;
  }

  double share_within(double tolerance) const {
    const json report = json::parse(text_of("out/gigaray.json"));
    const FloatMap depth = read_pfm(folder / "out/depth.pfm");
    const FloatMap exact =
        read_pfm(folder / ("walk/truth/" + report.at("centre").get<std::string>() + ".pfm"));
    int good = 0;
    for (std::size_t i = 0; i < depth.size(); ++i)
      good += std::abs(depth.data()[i] / exact.data()[i] - 1) < tolerance;
    return double(good) / double(depth.size());
  }

  ColmapModel model;
};

TEST_F(Convention, OtherAxesAndInversesAreNamedAndReadWhenStated) {
  for (const char* name : {"opencv", "opengl-w2c", "opencv-w2c", "llff", "ros"}) {
    SCOPED_TRACE(name);
    state(*parse_pose_convention(name));
    expect_refused(kDepth, name);
    expect_refused(std::string(kDepth) + "--disparity 0.1 1.2", name);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    const Result info = run("info walk");
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find(std::string("--convention ") + name), std::string::npos) << info.out;
    const Result result = run(std::string(kDepth) + "--convention " + name);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("don't fit"), std::string::npos) << result.err;
    EXPECT_GT(share_within(0.05), 0.6);
    std::filesystem::remove_all(folder / "out");
  }
}

TEST_F(Convention, LeftHandedScenesAreReadToo) {
  state(*parse_pose_convention("unity"), true);
  expect_refused(kDepth, "unity");
  const Result result = run(std::string(kDepth) + "--convention unity");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("left-handed"), std::string::npos) << result.err;
  EXPECT_GT(share_within(0.05), 0.6);
}

TEST_F(Convention, RightPosesAndScaledAxesPassWithoutAWord) {
  for (const double scale : {1.0, 0.2}) {
    state(*parse_pose_convention("opengl"), false, scale);
    const Result result = run(std::string(kDepth) + "--replace");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("don't fit"), std::string::npos) << result.err;
    EXPECT_GT(share_within(0.05), 0.6);
  }
}

TEST_F(Convention, AStatedOneThatDoesNotFitIsAMessage) {
  state(*parse_pose_convention("opengl"));
  const Result result = run(std::string(kDepth) + "--disparity 0.1 1.2 --convention opencv");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("don't fit the pictures"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--convention opengl"), std::string::npos) << result.err;
  expect_failure(std::string(kDepth) + "--convention blender", 2, "--convention", "opengl");
  ASSERT_EQ(run("synth planes -o row --views 3 --width 32 --height 32").exit_code, 0);
  expect_failure("info row --convention opencv", 2, "--convention", "cameras are known");
}

TEST_F(Convention, PosesOfOtherPicturesFitInNone) {
  std::rotate(model.images.begin(), model.images.begin() + 2, model.images.end());
  std::vector<std::string> names;
  for (const ColmapModel::Image& image : model.images) names.push_back(image.name);
  std::ranges::sort(names);
  for (std::size_t i = 0; i < names.size(); ++i) model.images[i].name = names[i];
  std::swap(model.images[0].name, model.images[3].name);
  state(*parse_pose_convention("opengl"));
  const Result result = run(kDepth);
  EXPECT_NE(result.err.find("don't fit the pictures"), std::string::npos) << result.err;
}

TEST_F(Convention, AModelOfColmapWithoutPointsIsHeldAgainstThePicturesToo) {
  for (ColmapModel::Image& image : model.images) {
    image.features.clear();
    const CameraPose pose{image.rotation.toRotationMatrix(), image.translation, false};
    const CameraPose inverse =
        read_pose(state_pose(pose, {"RDF", false}), {"RDF", true}).value();  // q and t of c2w
    image.rotation = Eigen::Quaterniond(inverse.rotation);
    image.translation = inverse.translation;
  }
  model.points.clear();
  write_colmap_model(folder / "walk/sparse/0", model, ColmapFormat::kText);
  expect_refused(kDepth, "opencv");
  const Result result = run(std::string(kDepth) + "--convention opencv");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(share_within(0.05), 0.6);
}

class Layout : public ProgramTest {
 protected:
  /// Numbers the views of a synthetic grid, columns × rows, one by one.
  void number(const std::string& grid, const std::string& pattern) const {
    const Result result = run("synth planes -o lf --width 96 --height 72 --grid " + grid);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::filesystem::create_directory(folder / "p");
    std::vector<std::filesystem::path> views;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "lf"))
      if (entry.path().extension() == ".png" &&
          entry.path().filename().string().starts_with("view"))
        views.push_back(entry.path());
    std::ranges::sort(views);
    for (std::size_t i = 0; i < views.size(); ++i) {
      char name[40];
      std::snprintf(name, sizeof name, pattern.c_str(), int(i));
      std::filesystem::copy_file(views[i], folder / "p" / name);
    }
  }
  double share_wrong() const {
    const FloatMap map = read_pfm(folder / "out/disparity.pfm"),
                   truth = read_pfm(folder / "lf/truth.pfm");
    int wrong = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
      wrong += !(std::abs(map.data()[i] - truth.data()[i]) < 0.1);
    return double(wrong) / double(map.size());
  }
};

TEST_F(Layout, AGridNumberedRowByRowIsTakenAsOne) {
  number("7x5", "lf_%03d.png");
  const Result result = run("depth p -o out --views centre");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("5 rows of 7"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--grid 5x7"), std::string::npos) << result.err;
  EXPECT_LT(share_wrong(), 0.15);
  // As a row and as a grid, in every layout and direction: each picture once.
  EXPECT_NE(text_of("out/gigaray.json").find("\"pictures_decoded\": 35,"), std::string::npos);
  const Result info = run("info p");
  EXPECT_NE(info.out.find("4D"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("--grid 5x7"), std::string::npos) << info.out;
}

TEST_F(Layout, AStatedGridThatAgreesWorseThanAnotherIsTold) {
  number("7x5", "lf_%03d.png");
  const Result result = run("depth p -o out --views centre --grid 7x5");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("--grid 5x7 would state it"), std::string::npos) << result.err;
  const Result right = run("depth p -o out --views centre --grid 5x7");
  EXPECT_EQ(right.err.find("would state it"), std::string::npos) << right.err;
  EXPECT_LT(share_wrong(), 0.15);
  const Result line = run("depth p -o out --views centre --direction right");
  EXPECT_NE(line.err.find("--grid 5x7 would state it"), std::string::npos) << line.err;
}

TEST_F(Layout, PositionsThatPointUpwardsAreTold) {
  number("7x5", "lf_%03d.png");
  const auto write_positions = [&](int down) {
    std::ofstream file(folder / "places.txt");
    for (int i = 0; i < 35; ++i) file << 10 * (i % 7) << " " << down * 10 * (i / 7) << "\n";
  };
  const std::string command = "depth p -o out --views centre --positions places.txt";
  write_positions(1);
  const Result right = run(command);
  ASSERT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(right.err.find("in doubt"), std::string::npos) << right.err;
  EXPECT_LT(share_wrong(), 0.15);
  // What goes on from the result opens the input with what was said of it.
  for (int i = 0; i < 35; ++i) {
    char name[40];
    std::snprintf(name, sizeof name, "lf_%03d.png", i);
    std::filesystem::rename(folder / "p" / name, folder / "p" /
                                                     (std::string(1, char('A' + i / 26)) +
                                                      std::string(1, char('a' + i % 26)) + ".png"));
  }
  ASSERT_EQ(run(command).exit_code, 0);
  const Result rendered = run("render out --pose 0.5,0 -o novel");
  EXPECT_EQ(rendered.exit_code, 0) << rendered.err;
  write_positions(-1);
  const Result upwards = run(command);
  EXPECT_NE(upwards.err.find("with the sign of down changed"), std::string::npos) << upwards.err;
}

TEST_F(Layout, ASceneOfHciWithoutParametersMayHaveAnyGrid) {
  number("7x5", "input_Cam%03d.png");
  const Result result = run("depth p -o out --views centre");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("--grid 5x7 states it"), std::string::npos) << result.err;
  EXPECT_LT(share_wrong(), 0.15);
  // Rows and columns swapped in its own file.
  std::ofstream(folder / "p/parameters.cfg") << "[extrinsics]\nnum_cams_x = 5\nnum_cams_y = 7\n";
  const Result swapped = run("depth p -o out --views centre");
  EXPECT_EQ(swapped.exit_code, 0) << swapped.err;
  EXPECT_NE(swapped.err.find("--grid 5x7 would state it"), std::string::npos) << swapped.err;
}

}  // namespace
}  // namespace gigaray
