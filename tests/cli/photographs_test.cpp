// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Depth of photographs from anywhere: with known cameras, and with those that COLMAP finds.
#include <signal.h>

#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

class Photographs : public ProgramTest {
 protected:
  static constexpr const char* kFast = " --hypotheses 96 ";

  void photograph(const std::string& options = "") const {
    const Result result =
        run("synth planes -o walk --path walk --views 6 --width 240 --height 160 "
            "--extent 0.3 --samples 2 " +
            options);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  json report(const std::string& out) const { return json::parse(text_of(out + "/gigaray.json")); }
  /// Share of the pixels whose depth is within a share of scale · truth.
  double within(const std::string& map, const std::string& truth, double tolerance,
                double scale = 1) const {
    const FloatMap depth = read_pfm(folder / map), exact = read_pfm(folder / truth);
    int good = 0;
    for (std::size_t i = 0; i < depth.size(); ++i)
      good += std::abs(depth.data()[i] / (scale * exact.data()[i]) - 1) < tolerance;
    return double(good) / double(depth.size());
  }
};

TEST_F(Photographs, WithKnownCamerasHaveDepthInTheirUnit) {
  photograph();
  const Result result = run(std::string("depth walk -o out") + kFast);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(report("out").at("light_field").at("kind"), "unstructured");
  EXPECT_EQ(report("out").at("views").size(), 6u);
  for (const char* view : {"view_000", "view_003", "view_005"})
    EXPECT_GT(within(std::string("out/") + view + "/depth.pfm",
                     std::string("walk/truth/") + view + ".pfm", 0.02),
              0.85)
        << view;
  EXPECT_EQ(names_in("."), (Names{"out", "walk"}));
}

TEST_F(Photographs, WithoutPointsAreSearchedWhereTheirFeaturesAre) {
  photograph();
  // Poses alone.
  std::istringstream lines(text_of("walk/sparse/0/images.txt"));
  std::string line, poses;
  for (bool is_pose = true; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    poses += is_pose ? line + "\n" : "\n";
    is_pose = !is_pose;
  }
  std::ofstream(folder / "walk/sparse/0/images.txt") << poses;
  std::ofstream(folder / "walk/sparse/0/points3D.txt") << "# none\n";
  const Result info = run("info walk --json");
  ASSERT_EQ(info.exit_code, 0) << info.err;
  const json told = json::parse(info.out);
  EXPECT_NE(told.at("notes").dump().find("features that the pictures share"), std::string::npos)
      << told.at("notes");
  for (const json& view : told.at("views")) {
    const json& range = view.at("camera").at("inverse_depth");
    const FloatMap depth =
        read_pfm(folder / "walk/truth" / (view.at("name").get<std::string>() + ".pfm"));
    const auto [near, far] = std::ranges::minmax(depth);
    EXPECT_LE(range.at(0).get<double>(), 1 / far);
    EXPECT_GE(range.at(1).get<double>(), 1 / near);
    EXPECT_LT(range.at(1).get<double>() - range.at(0).get<double>(), 1.6 * (1 / near - 1 / far));
  }
}

TEST_F(Photographs, AloneGetTheirCamerasFromColmap) {
  photograph();
  const Result result =
      run(std::string("depth walk/images -o out --find-cameras --views centre") + kFast);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("COLMAP found the cameras of 6 of 6"), std::string::npos) << result.err;
  // Where its files go is said before it starts; and what its scale is.
  EXPECT_LT(result.err.find("out.colmap"), result.err.find("COLMAP found"));
  EXPECT_NE(result.err.find("which COLMAP chose, not in metres"), std::string::npos) << result.err;
  const Result cloud = run("cloud out -o points.ply --min-support 0");
  EXPECT_NE(cloud.err.find("not in metres"), std::string::npos) << cloud.err;
  std::filesystem::remove(folder / "points.ply");
  EXPECT_EQ(names_in("."), (Names{"out", "out.colmap", "walk"}));
  // COLMAP's scale is its own.
  const std::string view = report("out").at("centre");
  const std::string map = "out/" + view + "/depth.pfm", truth = "walk/truth/" + view + ".pfm";
  const FloatMap depth = read_pfm(folder / map), exact = read_pfm(folder / truth);
  std::vector<float> ratios;
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (std::isfinite(depth.data()[i])) ratios.push_back(depth.data()[i] / exact.data()[i]);
  ASSERT_FALSE(ratios.empty());
  std::nth_element(ratios.begin(), ratios.begin() + long(ratios.size() / 2), ratios.end());
  EXPECT_GT(within(map, truth, 0.03, ratios[ratios.size() / 2]), 0.7);

  // The next run takes the cameras that are there; other photographs are looked at anew.
  const std::string once_more = "depth walk/images -o out --find-cameras --views centre";
  const Result again = run(once_more + kFast);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("as COLMAP found them before"), std::string::npos) << again.err;
  expect_refusal(once_more + " --quality best", 2, "--quality", "low, medium or high");
  const Result closer = run(once_more + " --quality high" + kFast);
  ASSERT_EQ(closer.exit_code, 0) << closer.err;
  EXPECT_NE(text_of("out.colmap/colmap.log").find("max_num_features 8192"), std::string::npos);
}

TEST_F(Photographs, AFolderOfSomebodyElseInPlaceOfTheCamerasStays) {
  photograph();
  std::filesystem::create_directory(folder / "out.colmap");
  for (const char* name : {"colmap.log", "database.db", "photographs.txt"}) {
    std::ofstream(folder / "out.colmap" / name) << "mine";
    expect_refusal("depth walk/images -o out --find-cameras", 2, "out.colmap", "--replace");
    EXPECT_EQ(text_of(std::string("out.colmap/") + name), "mine");
  }
}

TEST_F(Photographs, ColmapEndsWithTheRunThatIsKilled) {
  photograph();
  const auto processes = [&] {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream file(entry.path() / "cmdline", std::ios::binary);
      const std::string words{std::istreambuf_iterator<char>(file), {}};
      count += words.find(folder.string()) != std::string::npos;
    }
    return count;
  };
  const pid_t child = start({"depth", "walk/images", "-o", "out", "--find-cameras"});
  ASSERT_TRUE(wait_until([&] { return processes() > 0; })) << text_of(".err");
  kill(child, SIGKILL);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_TRUE(wait_until([&] { return processes() == 0; }));
  EXPECT_FALSE(names_in(".").contains("out.colmap"));
  EXPECT_EQ(run("synth planes -o small --width 16 --height 16").exit_code, 0);
  EXPECT_EQ(names_in("."), (Names{"small", "walk"})) << "the next run tidies up";
}

TEST_F(Photographs, WithoutColmapOneLineSaysSo) {
  photograph();
  expect_refusal("depth walk/images -o out --find-cameras", 1, "colmap", "not installed",
                 "PATH=/nowhere");
}

TEST_F(Photographs, OfNothingInCommonAreRefusedWithWhatToTry) {
  std::filesystem::create_directory(folder / "photos");
  std::uint32_t state = 1;
  for (int i = 0; i < 3; ++i) {
    Image<std::uint16_t> noise(96, 64, 3);
    for (std::size_t k = 0; k < noise.size(); ++k)
      noise.data()[k] = std::uint16_t((state = state * 1664525u + 1013904223u) >> 24);
    write_png(folder / ("photos/" + std::to_string(i) + ".png"), noise, 8);
  }
  const Result result = run("depth photos -o out --find-cameras");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("gigaray depth: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("should share"), std::string::npos) << result.err;
  EXPECT_FALSE(names_in(".").contains("out"));
}

TEST_F(Photographs, ADenseWorkspaceIsFusedByColmapItself) {
  photograph();
  const Result result = run(std::string("depth walk -o out --format colmap") + kFast);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_EQ(std::system(("cd '" + folder.string() +
                         "' && colmap stereo_fusion --workspace_path out/colmap --output_path "
                         "points.ply --StereoFusion.min_num_pixels 3 >fusion.log 2>&1")
                            .c_str()),
            0)
      << text_of("fusion.log");
  const std::string points = text_of("points.ply");
  const std::string head = "element vertex ";
  const auto at = points.find(head);
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(std::stoi(points.substr(at + head.size())), 5000);

  ASSERT_EQ(run("synth planes -o row --views 3 --width 40 --height 31").exit_code, 0);
  expect_refusal("depth row -o other --format colmap", 2, "--format colmap");
}

TEST_F(Photographs, MasksLeaveOutWhatIsBlack) {
  photograph();
  std::filesystem::create_directory(folder / "masks");
  Image<std::uint16_t> mask(240, 160, 3);
  for (int v = 0; v < 160; ++v)
    for (int u = 0; u < 240; ++u)
      for (int c = 0; c < 3; ++c) mask(u, v, c) = v < 40 ? 0 : 255;
  write_png(folder / "masks/view_003.png", mask, 8);
  const Result result =
      run(std::string("depth walk -o out --masks masks --views view_003") + kFast);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("5 of 6 pictures have no mask"), std::string::npos) << result.err;
  const FloatMap depth = read_pfm(folder / "out/view_003/depth.pfm");
  for (int u = 0; u < 240; u += 7) {
    EXPECT_TRUE(std::isnan(depth(u, 20))) << u;
    EXPECT_FALSE(std::isnan(depth(u, 100))) << u;
  }
  expect_refusal("depth walk -o other --masks walk/truth", 1, "holds no mask");
}

TEST_F(Photographs, DamageToAModelIsOneLine) {
  photograph();
  const auto path = folder / "walk/sparse/0/images.txt";
  const std::string good = text_of("walk/sparse/0/images.txt");
  std::ofstream(path) << good.substr(0, good.size() / 2);
  expect_refusal("depth walk -o out", 1, "images.txt");
  std::ofstream(path) << good;
  std::filesystem::remove(folder / "walk/images/view_002.png");
  expect_refusal("depth walk -o out --strict", 1, "view_002.png", "is missing");
  std::ofstream(folder / "walk/sparse/0/cameras.txt") << "1 PINHOLE 240 160 nan 1 2 3\n";
  expect_refusal("depth walk -o out", 1, "cameras.txt");
}

TEST_F(Photographs, OneThatIsMissingIsNamedAndLeftOut) {
  photograph();
  std::filesystem::remove(folder / "walk/images/view_002.png");
  const Result result = run("info walk");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("is left out: view_002 (is missing)"), std::string::npos) << result.out;
}

TEST_F(Photographs, TwiceInAFolderNeverGoToColmap) {
  ASSERT_EQ(run("synth planes --views 4 --width 64 --height 48 -o made").exit_code, 0);
  std::filesystem::create_directory(folder / "twice");
  for (int i = 0; i < 4; ++i) {
    const std::string name = "view_00" + std::to_string(i);
    for (const char* copy : {".png", ".jpg"})
      std::filesystem::copy(folder / "made" / (name + ".png"), folder / "twice" / (name + copy));
  }
  for (const char* command :
       {"info twice", "depth twice -o out", "depth twice -o out --find-cameras"})
    expect_refusal(command, 1, "twice: holds pictures twice", "keep one of each");
}

TEST_F(Photographs, AreShrunkOnDemand) {
  photograph();
  const Result result = run(std::string("depth walk -o out --max-size 120 --views centre") + kFast);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(report("out").at("light_field").at("width"), 120);
  EXPECT_EQ(report("out").at("light_field").at("height"), 80);
}

TEST_F(Photographs, AProbeSpeaksOfInverseDepth) {
  photograph();
  const Result result = run(std::string("probe walk --at 120 80 -o out") + kFast);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("(inverse depth)"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\ndepth "), std::string::npos) << result.out;
  EXPECT_EQ(names_in("out"), (Names{"gigaray.json", "samples.png", "scores.png"}));
}

}  // namespace
}  // namespace gigaray
