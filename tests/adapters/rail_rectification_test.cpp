// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A rendered rail that is not perfect: its cameras are known exactly.
#include "gigaray/adapters/rail_rectification.h"

#include <algorithm>

#include "adapters/adapters_test.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/synthetic_capture.h"

namespace gigaray {
namespace {

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

class UnsteadyRail : public AdaptersTest {
 protected:
  static constexpr int kViews = 6;

  UnsteadyRail() {
    options.scene = "planes";
    options.width = 320;
    options.height = 214;
    options.views_s = kViews;
    options.samples = 2;
    path.shape = SyntheticPath::Shape::kLine;
    path.extent = 0.15;
    path.spacing_noise = 0.12;
    path.rotation_noise = 0.4;
    path.distortion = -0.1;
    capture = describe_synthetic_capture(options, path);
    std::filesystem::create_directory(folder / "photos");
    render_synthetic_capture(
        options, path, RunControl(),
        [&](int i, Image<std::uint16_t> picture, FloatMap) { write_png(file(i), picture, 8); });
    lens = {
        "SIMPLE_RADIAL",
        options.width,
        options.height,
        {capture.cameras[0].focal_u, options.width / 2.0, options.height / 2.0, path.distortion}};
  }

  std::filesystem::path file(int view) const {
    return folder / "photos" / (capture.names[view] + ".png");
  }
  RailPhotographs open(const KnownLens& known) const {
    return open_rail_in_order(folder / "photos", known);
  }
  ColmapModel model() const {
    ColmapModel model;
    model.cameras[1] = lens;
    for (int i = 0; i < kViews; ++i) {
      ColmapModel::Image image;
      image.id = std::uint32_t(i + 1);
      image.camera_id = 1;
      image.rotation = Eigen::Quaterniond(capture.cameras[i].rotation).normalized();
      image.translation = capture.cameras[i].translation;
      image.name = capture.names[i] + ".png";
      model.images.push_back(image);
    }
    return model;
  }

  /// Where the rectified view shows what the photograph shows at a pixel.
  static Eigen::Vector2d rectified(const RectifiedRail& rail, int view,
                                   const Eigen::Vector2d& pixel) {
    const RailSource source = source_of(rail, view);
    const Eigen::Vector3d ray =
        source.rotation.transpose() * undistort(source.lens, pixel).value().homogeneous();
    const Camera& camera = rail.camera;
    return {camera.focal_u * ray.x() / ray.z() + camera.centre_u,
            camera.focal_v * ray.y() / ray.z() + camera.centre_v};
  }

  /// Median difference of the rows at which neighbouring views show the same point.
  double rows_differ(const RectifiedRail& rail) const {
    std::vector<double> differences;
    for (const auto& point : capture.points)
      for (std::size_t k = 1; k < point.sights.size(); ++k) {
        const auto &a = point.sights[k - 1], &b = point.sights[k];
        differences.push_back(std::abs(rectified(rail, a.view_idx, a.pixel).y() -
                                       rectified(rail, b.view_idx, b.pixel).y()));
      }
    return median(differences);
  }

  /// Median error of the depth that the first and the last view of a light field in true scale say
  /// of the points that both show, relative.
  double depth_error(const RectifiedRail& rail) const {
    const double length = rail.positions.back() - rail.positions.front();
    const double scale =
        (capture.cameras.back().position() - capture.cameras.front().position()).norm() / length;
    std::vector<double> errors;
    for (const auto& point : capture.points) {
      const auto &a = point.sights.front(), &b = point.sights.back();
      if (a.view_idx != 0 || b.view_idx != kViews - 1) continue;
      const double shift =
          rectified(rail, 0, a.pixel).x() - rectified(rail, kViews - 1, b.pixel).x();
      const double depth = rail.camera.focal_u * length * scale / shift;
      errors.push_back(std::abs(depth / capture.cameras[0].project(point.position).z() - 1));
    }
    return median(errors);
  }

  SyntheticOptions options;
  SyntheticPath path;
  SyntheticCapture capture;
  Lens lens;
};

TEST_F(UnsteadyRail, RowsBecomeEpipolarLinesFromTheOrderAlone) {
  KnownLens known;
  known.focal_px = capture.cameras[0].focal_u;
  const RailPhotographs photographs = open(known);
  EXPECT_FALSE(photographs.posed);
  EXPECT_TRUE(photographs.focal_is_known);
  EXPECT_FALSE(photographs.distortion_is_known);
  const RectifiedRail rail = calibrate_rail(photographs, RailRotations::kBest, RunControl());
  EXPECT_GT(rail.report.vertical_before.median, 1);
  EXPECT_LT(rows_differ(rail), 0.25);
  EXPECT_TRUE(rail.report.own_rotations);
  EXPECT_NEAR(rail.report.rotation_rms_deg, 0.4 * std::sqrt(3), 0.3);
  EXPECT_FALSE(rail.report.line);
  EXPECT_EQ(source_of(rail, 0).lens.model, "RADIAL");
  EXPECT_NEAR(source_of(rail, 0).lens.params[3], path.distortion, 0.06);

  const LightField light_field = rectified_light_field(rail, 30.0);
  EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
  EXPECT_EQ(light_field.rig.unit, "mm");
  ASSERT_EQ(light_field.num_views(), kViews);
  const double true_length =
      capture.cameras.back().position().x() - capture.cameras.front().position().x();
  const double length = light_field.views.back().s - light_field.views.front().s;
  EXPECT_NEAR(length * *light_field.rig.baseline, 30.0 * (kViews - 1), 1e-6);
  for (int i = 0; i < kViews; ++i) {
    EXPECT_EQ(light_field.views[i].name, capture.names[i]);
    const double share = (light_field.views[i].s - light_field.views[0].s) / length;
    const double true_share =
        (capture.cameras[i].position().x() - capture.cameras[0].position().x()) / true_length;
    EXPECT_NEAR(share, true_share, 0.02) << i;
  }
  const Image<std::uint16_t> view = light_field.pixels->read(2);
  EXPECT_EQ(view.width(), light_field.width);
  EXPECT_GT(view.width(), 0.85 * options.width);
}

TEST_F(UnsteadyRail, KnownCamerasGiveDepthInTheirUnit) {
  write_colmap_model(folder / "sparse/0", model(), ColmapFormat::kBinary);
  EXPECT_TRUE(has_colmap_model(folder));
  EXPECT_FALSE(has_colmap_model(folder / "photos"));
  const RailPhotographs photographs = with_colmap_cameras(open({}), folder);
  EXPECT_TRUE(photographs.posed);
  EXPECT_TRUE(photographs.lens_note.empty());
  const RectifiedRail rail = calibrate_rail(photographs, RailRotations::kBest, RunControl());
  ASSERT_TRUE(rail.report.line);
  EXPECT_LT(rail.report.line->rms_distance, 1e-9);
  EXPECT_EQ(source_of(rail, 3).lens, lens);
  EXPECT_LT(rows_differ(rail), 0.2);
  EXPECT_LT(depth_error(rail), 0.02);
  const LightField light_field = rectified_light_field(rail, {});
  ASSERT_TRUE(light_field.rig.baseline);
  EXPECT_NEAR(*light_field.rig.baseline, path.extent / (kViews - 1), 0.008);
}

TEST_F(UnsteadyRail, CamerasBesideTheLineDoNotShiftAllDepths) {
  path.off_line = 0.0015;
  path.rotation_noise = 0.3;
  capture = describe_synthetic_capture(options, path);
  render_synthetic_capture(
      options, path, RunControl(),
      [&](int i, Image<std::uint16_t> picture, FloatMap) { write_png(file(i), picture, 8); });
  KnownLens known;
  known.lens = lens;
  const RectifiedRail rail = calibrate_rail(open(known), RailRotations::kOwn, RunControl());
  EXPECT_LT(rows_differ(rail), 0.4);
  EXPECT_LT(depth_error(rail), 0.03);
}

TEST_F(UnsteadyRail, PhotographsWithoutACameraAreLeftOutAndNamed) {
  ColmapModel partial = model();
  partial.images.erase(partial.images.begin() + 2);
  write_colmap_model(folder / "sparse/0", partial, ColmapFormat::kText);
  const RailPhotographs photographs = with_colmap_cameras(open({}), folder);
  EXPECT_EQ(photographs.pictures.size(), std::size_t(kViews - 1));
  ASSERT_EQ(photographs.notes.size(), 1u);
  EXPECT_NE(photographs.notes[0].find("view_002.png"), std::string::npos);

  partial.images.resize(2);
  write_colmap_model(folder / "sparse/0", partial, ColmapFormat::kText);
  expect_error(ErrorCode::kBadInput, "3 or more", [&] { with_colmap_cameras(open({}), folder); });
  partial = model();
  partial.cameras[1].width = 640;
  write_colmap_model(folder / "sparse/0", partial, ColmapFormat::kText);
  expect_error(ErrorCode::kBadInput, "640×214", [&] { with_colmap_cameras(open({}), folder); });
  expect_error(ErrorCode::kBadInput, "no model",
               [&] { with_colmap_cameras(open({}), folder / "photos"); });
}

TEST_F(UnsteadyRail, WhatIsNoRailIsNamed) {
  // A stranger in the middle.
  cv::Mat noise(options.height, options.width, CV_8UC3);
  cv::randu(noise, 0, 255);
  cv::imwrite(file(3).string(), noise);
  KnownLens known;
  known.lens = lens;
  expect_error(ErrorCode::kBadInput, "shares too few features",
               [&] { calibrate_rail(open(known), RailRotations::kBest, RunControl()); });
  save("photos/view_003.png");
  expect_error(ErrorCode::kBadInput, "need one size", [&] { open(known); });
  for (int i = 2; i < kViews; ++i) std::filesystem::remove(file(i));
  expect_error(ErrorCode::kBadInput, "a rail needs 3 or more", [&] { open(known); });
  known.lens->params[0] = -5;
  render_synthetic_capture(
      options, path, RunControl(),
      [&](int i, Image<std::uint16_t> picture, FloatMap) { write_png(file(i), picture, 8); });
  expect_error(ErrorCode::kInvalidArgument, "the lens", [&] { open(known); });
}

TEST_F(UnsteadyRail, ACameraThatLeavesTheLineIsNoRail) {
  ColmapModel bent = model();
  bent.images[2].translation += Eigen::Vector3d(0, 0.1, 0);
  write_colmap_model(folder / "sparse/0", bent, ColmapFormat::kText);
  const RailPhotographs photographs = with_colmap_cameras(open({}), folder);
  expect_error(ErrorCode::kBadInput, "don't stand on a line",
               [&] { calibrate_rail(photographs, RailRotations::kBest, RunControl()); });
}

}  // namespace
}  // namespace gigaray
