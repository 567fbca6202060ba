// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Captures as they come from elsewhere, through all commands: a pair of Middlebury's newer sets,
// and cameras in world coordinates.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class CalibratedPairCommands : public ProgramTest {
 protected:
  /// A pair with exact truth, a part of which is not known.
  CalibratedPairCommands() {
    EXPECT_EQ(
        run("synth planes -o made --width 96 --height 73 --views 2 --disparity 2 8").exit_code, 0);
    fs::create_directory(folder / "pair");
    fs::copy_file(folder / "made/view_000.png", folder / "pair/im0.png");
    fs::copy_file(folder / "made/view_001.png", folder / "pair/im1.png");
    std::ofstream(folder / "pair/calib.txt")
        << "cam0=[150 0 48; 0 150 36; 0 0 1]\ncam1=[150 0 50; 0 150 36; 0 0 1]\ndoffs=2\n"
           "baseline=176.2\nwidth=96\nheight=73\nndisp=12\n";
    truth = read_pfm(folder / "made/truth.pfm");
    for (int v = 0; v < truth.height(); ++v) truth(90, v) = INFINITY;
  }
  FloatMap truth;
};

TEST_F(CalibratedPairCommands, DepthIsInMillimetres) {
  const Result about = run("info pair --json");
  ASSERT_EQ(about.exit_code, 0) << about.err;
  EXPECT_EQ(json::parse(about.out).at("rig").at("focal_px"), 150);
  ASSERT_EQ(run("depth pair -o out --views centre").exit_code, 0);
  const FloatMap disparity = read_pfm(folder / "out/disparity.pfm"),
                 depth = read_pfm(folder / "out/depth.pfm");
  int known = 0;
  for (std::size_t i = 0; i < disparity.size(); ++i)
    if (std::isfinite(depth.data()[i])) {
      ++known;
      ASSERT_NEAR(depth.data()[i], 150 * 176.2 / (disparity.data()[i] + 2), 0.1);
    }
  EXPECT_GT(known, int(disparity.size() / 2));
  const json rig = json::parse(text_of("out/gigaray.json")).at("light_field").at("rig");
  EXPECT_EQ(rig.at("principal_point_px"), json({49, 36}));
  // A point of the mesh lies on the ray of a pixel: its optical axis is at (48, 36) of im0, which
  // stands half a view step to the left.
  ASSERT_EQ(run("mesh out -o out.ply --min-support 0").exit_code, 0);
  const std::string text = text_of("out.ply");
  const std::size_t body = text.find("end_header\n") + 11;
  for (std::size_t i = 0; i < 500; ++i) {
    float p[3];
    std::memcpy(p, text.data() + body + 27 * i, sizeof p);
    const double u = 150 * (p[0] + 176.2 / 2) / p[2] + 48, v = 150 * p[1] / p[2] + 36;
    ASSERT_NEAR(u, std::round(u), 1e-2);
    ASSERT_NEAR(v, std::round(v), 1e-2);
  }
}

TEST_F(CalibratedPairCommands, TruthIsFoundUnderBothNamesAndInfinityIsUnknown) {
  ASSERT_EQ(run("depth pair -o out --views centre").exit_code, 0);
  for (const std::string name : {"disp0.pfm", "disp0GT.pfm"}) {
    write_pfm(folder / "pair" / name, truth);
    const Result result = run("evaluate out pair --metrics middlebury --json");
    ASSERT_EQ(result.exit_code, 0) << name << result.err;
    const json scores = json::parse(result.out);
    EXPECT_LT(scores.at("bad2.0").get<double>(), 30) << result.out;
    fs::remove(folder / "pair" / name);
  }
  write_pfm(folder / "pair/disp0GT.pfm", truth);
  cv::Mat mask(73, 96, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, 20) = 128;
  cv::imwrite((folder / "pair/mask0nocc.png").string(), mask);
  const Result result = run("evaluate out pair --metrics middlebury --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("nonocc."), std::string::npos) << result.out;
  const Result contest = run("compare pair -o contest --methods auto,sgbm");
  EXPECT_EQ(contest.exit_code, 0) << contest.err;
  EXPECT_NE(contest.err.find("disp0GT.pfm"), std::string::npos) << contest.err;
}

class WorldCoordinates : public ProgramTest {
 protected:
  WorldCoordinates() {
    EXPECT_EQ(run("synth garden --path walk --views 5 --width 96 --height 72 -o made").exit_code,
              0);
  }
  /// The capture with its scene moved; cloud.ply of it and what --json says.
  json cloud_of(const std::string& name, const Eigen::Vector3d& by) {
    ColmapModel model = read_colmap_model(folder / "made/sparse/0");
    for (auto& image : model.images) image.translation -= image.rotation * by;
    for (auto& point : model.points) point.position += by;
    write_colmap_model(folder / name / "sparse/0", model, ColmapFormat::kText);
    fs::create_directory_symlink(folder / "made/images", folder / name / "images");
    EXPECT_EQ(run("depth " + name + " -o " + name + ".depth --format colmap").exit_code, 0);
    const Result result = run("cloud " + name + ".depth -o " + name + ".ply --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  static Eigen::Vector3d vector(const json& list) {
    return Eigen::Vector3d(list[0].get<double>(), list[1].get<double>(), list[2].get<double>());
  }

  /// Mean of the positions in a cloud, without its origin.
  Eigen::Vector3d mean_of(const std::string& name) const {
    const std::string text = text_of(name);
    const std::size_t body = text.find("end_header\n") + 11;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t count = (text.size() - body) / 35;
    for (std::size_t i = 0; i < count; ++i) {
      float p[3];
      std::memcpy(p, text.data() + body + 35 * i, sizeof p);
      sum += Eigen::Vector3d(p[0], p[1], p[2]) / double(count);
    }
    return sum;
  }
};

TEST_F(WorldCoordinates, AreKeptToTheMillimetre) {
  const json near = cloud_of("near", Eigen::Vector3d::Zero());
  EXPECT_EQ(vector(near.at("origin")), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(500123.25, 4649776.5, 210),
                                       Eigen::Vector3d(4201853.125, -172044.75, 4780011.5)}) {
    const std::string name = place.x() < 1e6 ? "utm" : "ecef";
    const json far = cloud_of(name, place);
    const Eigen::Vector3d origin = vector(far.at("origin"));
    EXPECT_LT((origin - place).cwiseAbs().maxCoeff(), 200);
    const double count = near.at("points");
    EXPECT_NEAR(far.at("points").get<double>(), count, 0.05 * count);
    EXPECT_LT((mean_of(name + ".ply") + origin - place - mean_of("near.ply")).norm(), 0.05);
    EXPECT_NE(text_of(name + ".ply").find("comment origin "), std::string::npos);
    const json mesh = json::parse(run("mesh " + name + ".depth -o " + name + ".glb --json").out);
    EXPECT_EQ(mesh.at("origin"), far.at("origin"));
    // Cameras in world coordinates, in doubles, for COLMAP.
    const ColmapModel model = read_colmap_model(folder / (name + ".depth") / "colmap/sparse");
    const ColmapModel before = read_colmap_model(folder / "made/sparse/0");
    const auto position = [](const ColmapModel::Image& image) {
      return Eigen::Vector3d(-(image.rotation.conjugate() * image.translation));
    };
    const auto first = [](const ColmapModel& of) {
      return *std::ranges::min_element(of.images, {}, &ColmapModel::Image::name);
    };
    EXPECT_LT((position(first(model)) - place - position(first(before))).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace gigaray
