// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray depth --format nerfstudio`, read back by the reader of transforms.json.
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/reader.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class NerfstudioExport : public ProgramTest {
 protected:
  json transforms() const { return json::parse(text_of("out/nerfstudio/transforms.json")); }

  /// Share of the pixels whose depth is that of the PFM, within what 16 bit can tell.
  double agreement(const std::string& view) const {
    const FloatMap depth = read_pfm(folder / "out" / view / "depth.pfm");
    const cv::Mat steps = cv::imread((folder / "out/nerfstudio/depths" / (view + ".png")).string(),
                                     cv::IMREAD_UNCHANGED);
    if (steps.type() != CV_16U || steps.cols != depth.width() || steps.rows != depth.height())
      return -1;
    const double unit = transforms().at("depth_unit_scale_factor");
    int right = 0;
    for (int v = 0; v < depth.height(); ++v)
      for (int u = 0; u < depth.width(); ++u) {
        const double found = steps.at<std::uint16_t>(v, u) * unit;
        right += std::isnan(depth(u, v)) ? found == 0 : std::abs(found - depth(u, v)) <= unit;
      }
    return double(right) / double(depth.size());
  }
  std::size_t points() const {
    const std::string text = text_of("out/nerfstudio/points.ply"), key = "element vertex ";
    return std::stoul(text.substr(text.find(key) + key.size()));
  }
};

TEST_F(NerfstudioExport, PhotographsKeepPosesPicturesAndDepth) {
  ASSERT_EQ(run("synth plaster --path walk --distortion 0.05 -o walk --views 4 --width 64 "
                "--height 48 --samples 1")
                .exit_code,
            0);
  const Result result = run("depth walk -o out --format nerfstudio,npy");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const LightField field = open_light_field(folder / "out/nerfstudio");
  const DepthResult depth(folder / "out");
  EXPECT_EQ(field.format, "transforms.json");
  ASSERT_EQ(field.num_views(), 4);
  for (int i = 0; i < 4; ++i) {
    const Camera &found = field.cameras[i], &real = depth.light_field().cameras[i];
    EXPECT_EQ(field.views[i].name, depth.light_field().views[i].name);
    EXPECT_LT((found.rotation - real.rotation).norm(), 1e-6);
    EXPECT_LT((found.translation - real.translation).norm(), 1e-6);
    EXPECT_NEAR(found.focal_u, real.focal_u, 1e-6);
    EXPECT_NEAR(found.centre_u, real.centre_u, 1e-6);
    EXPECT_NEAR(found.centre_v, real.centre_v, 1e-6);
    const std::string& view = field.views[i].name;
    EXPECT_GT(agreement(view), 0.995) << view;
    const cv::Mat a = cv::imread((folder / "out/nerfstudio/images" / (view + ".png")).string());
    const cv::Mat b = cv::imread((folder / "out" / view / "picture.png").string());
    EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0);
  }
  EXPECT_GT(points(), 1000u);
  // Depth of it is depth of the photographs.
  ASSERT_EQ(run("depth walk -o first --depth 0.8 5 --views centre").exit_code, 0);
  const Result again = run("depth out/nerfstudio -o again --depth 0.8 5 --views centre");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const FloatMap first = read_pfm(folder / "first/depth.pfm");
  const FloatMap second = read_pfm(folder / "again/depth.pfm");
  int close = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    close += std::abs(first.data()[i] / second.data()[i] - 1) < 0.01;
  EXPECT_GT(close, 0.98 * double(first.size()));
}

TEST_F(NerfstudioExport, AGridStandsWithItsRig) {
  ASSERT_EQ(run("synth planes -o made --samples 2 --grid 3x3 --width 48 --height 37").exit_code, 0);
  ASSERT_EQ(run("depth made -o out --format nerfstudio").exit_code, 0);
  const json rig = json::parse(text_of("out/gigaray.json")).at("light_field").at("rig");
  const LightField field = open_light_field(folder / "out/nerfstudio");
  const DepthResult depth(folder / "out");
  ASSERT_EQ(field.num_views(), 9);
  const double step = rig.at("baseline"), focal = rig.at("focal_px");
  const double shift = focal * step / rig.at("focus_distance").get<double>();
  for (int i = 0; i < 9; ++i) {
    const View& view = depth.light_field().views[i];
    const Camera& camera = field.cameras[i];
    EXPECT_LT((camera.position() - step * Eigen::Vector3d(view.s, view.t, 0)).norm(), 1e-9);
    EXPECT_LT((camera.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(camera.focal_u, focal, 1e-9);
    EXPECT_NEAR(camera.centre_u, 23.5 + view.s * shift, 1e-6) << "shifted towards the focus";
    EXPECT_GT(agreement(view.name), 0.995) << view.name;
  }
  EXPECT_GT(points(), 1000u);
}

TEST_F(NerfstudioExport, LargeScenesGetAUnitThatHoldsThem) {
  ASSERT_EQ(run("synth planes -o made --samples 2 --views 3 --width 48 --height 37").exit_code, 0);
  ASSERT_EQ(run("depth made -o out --format nerfstudio --focal-px 57.6 --baseline 80 "
                "--focus-distance 1000 --unit mm")
                .exit_code,
            0);
  EXPECT_EQ(transforms().at("depth_unit_scale_factor"), 0.1);
  EXPECT_GT(agreement("view_001"), 0.995);
}

TEST_F(NerfstudioExport, NeedsARig) {
  ASSERT_EQ(run("synth planes -o bare --samples 2 --views 3 --width 48 --height 37").exit_code, 0);
  fs::remove(folder / "bare/gigaray.json");
  fs::remove(folder / "bare/truth.pfm");
  expect_refusal("depth bare -o out --direction right --format nerfstudio --disparity -1 1", 2,
                 "--format nerfstudio", "--focal-px");
}

}  // namespace
}  // namespace gigaray
