// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/synthetic_capture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string>

#include "support/errors.h"

namespace gigaray {
namespace {

using Shape = SyntheticPath::Shape;

struct Photographs {
  std::vector<Image<std::uint16_t>> pictures;
  std::vector<FloatMap> depth;
};

SyntheticOptions small(int num_views = 4) {
  SyntheticOptions options;
  options.scene = "garden";
  options.width = 93;
  options.height = 71;
  options.views_s = num_views;
  options.samples = 2;
  return options;
}

SyntheticPath path_of(Shape shape) {
  SyntheticPath path;
  path.shape = shape;
  return path;
}

Photographs render(const SyntheticOptions& options, const SyntheticPath& path) {
  Photographs out;
  out.pictures.resize(options.views_s);
  out.depth.resize(options.views_s);
  render_synthetic_capture(options, path, RunControl(),
                           [&](int i, Image<std::uint16_t> picture, FloatMap depth) {
                             out.pictures[i] = std::move(picture);
                             out.depth[i] = std::move(depth);
                           });
  return out;
}

TEST(SyntheticCapture, AStraightLineGivesThePicturesOfA3DLightField) {
  SyntheticOptions options = small(3);
  const SyntheticPath path = path_of(Shape::kLine);
  const Photographs photographs = render(options, path);

  const double focal = describe_synthetic_capture(options, path).cameras.front().focal_u;
  const double nearest = path.extent / 2 * focal;  // px per step at depth 1
  options.disparity = {nearest / 2.5, nearest};
  const SyntheticLightField row = render_synthetic(options, RunControl());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(photographs.pictures[i], row.light_field.pixels->read(i));
    for (int v = 0; v < options.height; ++v)
      for (int u = 0; u < options.width; ++u)
        ASSERT_NEAR(photographs.depth[i](u, v), nearest / row.disparity[i](u, v), 1e-4);
  }
}

/// Share of the pixels of the first photograph that the last one shows at the place and depth
/// that the cameras and the depth map say.
double share_found_again(const SyntheticCapture& capture, const Photographs& photographs) {
  const Camera &from = capture.cameras.front(), &to = capture.cameras.back();
  const FloatMap &depth = photographs.depth.front(), &other = photographs.depth.back();
  int inside = 0, found = 0;
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u) {
      const Eigen::Vector3d point = from.back_project(u, v, depth(u, v));
      if (!to.sees(point)) continue;
      const Eigen::Vector3d at = to.project(point);
      ++inside;
      found += std::abs(other(int(at.x() + 0.5), int(at.y() + 0.5)) / at.z() - 1) < 0.02;
    }
  return double(found) / inside;
}

class SyntheticPaths : public testing::TestWithParam<Shape> {};

TEST_P(SyntheticPaths, DepthAndCamerasAgree) {
  const SyntheticOptions options = small();
  const SyntheticPath path = path_of(GetParam());
  const double share =
      share_found_again(describe_synthetic_capture(options, path), render(options, path));
  EXPECT_GT(share, 0.75);  // the rest is hidden
}

TEST_P(SyntheticPaths, EverySightShowsItsPoint) {
  const SyntheticOptions options = small();
  SyntheticPath path = path_of(GetParam());
  path.rotation_noise = 1;
  path.off_line = 0.01;
  path.distortion = -0.1;
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  const Photographs photographs = render(options, path);
  ASSERT_GT(capture.points.size(), 1000u);
  int sights = 0, near_the_depth = 0;
  for (const auto& point : capture.points) {
    EXPECT_GE(point.sights.size(), 2u);
    for (const auto& sight : point.sights) {
      const Camera& camera = capture.cameras[sight.view_idx];
      const Eigen::Vector3d at = camera.project(point.position);
      const double x = (at.x() - camera.centre_u) / camera.focal_u;
      const double y = (at.y() - camera.centre_v) / camera.focal_v;
      const double k = 1 - 0.1 * (x * x + y * y);
      EXPECT_NEAR(sight.pixel.x(), camera.centre_u + k * x * camera.focal_u, 1e-9);
      EXPECT_NEAR(sight.pixel.y(), camera.centre_v + k * y * camera.focal_v, 1e-9);
      const float depth =
          photographs.depth[sight.view_idx](int(sight.pixel.x() + 0.5), int(sight.pixel.y() + 0.5));
      ++sights;
      near_the_depth += std::abs(depth / at.z() - 1) < 0.02;
    }
  }
  EXPECT_GT(near_the_depth, 0.9 * sights);  // others are beside an edge
}

INSTANTIATE_TEST_SUITE_P(Shapes, SyntheticPaths,
                         testing::Values(Shape::kLine, Shape::kArc, Shape::kWalk));

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / double(values.size()));
}

TEST(SyntheticCapture, NoiseHasTheSizeStated) {
  const SyntheticOptions options = small(400);
  SyntheticPath path = path_of(Shape::kLine);
  path.spacing_noise = 0.2;
  path.off_line = 0.03;
  path.rotation_noise = 2;
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  const double spacing = path.extent / 399;
  std::vector<double> along, across, turned;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d position = capture.cameras[i].position();
    along.push_back((position.x() + path.extent / 2) / spacing - i);
    across.push_back(position.y());
    across.push_back(position.z());
    turned.push_back(180 / std::numbers::pi *
                     std::acos(std::min(1.0, (capture.cameras[i].rotation.trace() - 1) / 2)));
  }
  EXPECT_NEAR(rms(along), 0.2, 0.03);
  EXPECT_NEAR(rms(across), 0.03, 0.003);
  EXPECT_NEAR(rms(turned), 2 * std::numbers::sqrt3, 0.3);
}

TEST(SyntheticCapture, APathOfTheHandLeavesTheLineAndLooksAtTheMiddle) {
  const SyntheticCapture capture = describe_synthetic_capture(small(20), path_of(Shape::kWalk));
  std::vector<double> up, forth;
  for (const Camera& camera : capture.cameras) {
    up.push_back(camera.position().y());
    forth.push_back(camera.position().z());
    const Eigen::Vector3d middle = camera.project({0, 0, 1 / 0.7});
    EXPECT_NEAR(middle.x(), camera.centre_u, 1e-9);
    EXPECT_NEAR(middle.y(), camera.centre_v, 1e-9);
  }
  EXPECT_GT(rms(up), 0.03);
  EXPECT_GT(rms(forth), 0.01);
}

SyntheticOptions small_scene(const std::string& scene, int num_views) {
  SyntheticOptions options = small(num_views);
  options.scene = scene;
  return options;
}

SyntheticPath around(Shape shape, double step) {
  SyntheticPath path = path_of(shape);
  path.step = step;
  return path;
}

/// Angles between neighbouring cameras as seen from the middle, degrees.
std::vector<double> steps_of(const SyntheticCapture& capture, const Eigen::Vector3d& middle) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < capture.cameras.size(); ++i) {
    const Eigen::Vector3d a = (capture.cameras[i].position() - middle).normalized();
    const Eigen::Vector3d b = (capture.cameras[i + 1].position() - middle).normalized();
    steps.push_back(180 / std::numbers::pi * std::acos(a.dot(b)));
  }
  return steps;
}

TEST(SyntheticCapture, CamerasOnAnArcStandAStepApart) {
  const Eigen::Vector3d middle_of_garden(0, 0, 1 / 0.7), middle_of_room(0, 0, 1.6);
  const auto expect = [](const SyntheticOptions& options, double step, const auto& middle) {
    const SyntheticCapture capture = describe_synthetic_capture(options, around(Shape::kArc, step));
    for (const double angle : steps_of(capture, middle)) EXPECT_NEAR(angle, step, 1e-6);
    for (const Camera& camera : capture.cameras)
      EXPECT_NEAR((camera.position() - middle).norm(), middle.z(), 1e-9);
  };
  expect(small(4), 2, middle_of_garden);
  expect(small_scene("room", 7), 20, middle_of_room);
  expect(small_scene("figure", 19), 20, middle_of_room);
}

TEST(SyntheticCapture, AWalkInStepsGoesUpAndDownAndToAndFroAroundTheMiddle) {
  constexpr double kStep = 10;
  const Eigen::Vector3d middle(0, 0, 1.6);
  const SyntheticCapture capture =
      describe_synthetic_capture(small_scene("room", 12), around(Shape::kWalk, kStep));
  for (const double angle : steps_of(capture, middle)) EXPECT_NEAR(angle, kStep, 0.25 * kStep);
  std::vector<double> up, forth;
  for (const Camera& camera : capture.cameras) {
    up.push_back(camera.position().y());
    forth.push_back((camera.position() - middle).norm() - middle.z());
  }
  EXPECT_GT(rms(up), 0.03);
  EXPECT_GT(rms(forth), 0.01);
  EXPECT_LT(*std::max_element(up.begin(), up.end()), 0.2) << "above the floor";
}

TEST(SyntheticCapture, WideStepsKeepDepthAndCamerasInAgreement) {
  for (const std::string scene : {"room", "figure"}) {
    const SyntheticOptions options = small_scene(scene, 2);
    const SyntheticPath path = around(Shape::kArc, 15);
    const double share =
        share_found_again(describe_synthetic_capture(options, path), render(options, path));
    EXPECT_GT(share, scene == "room" ? 0.75 : 0.5) << scene;  // the rest is hidden
  }
}

TEST(SyntheticCapture, WhatIsWhiteAroundTheFigureHasNoDepthAndNoPoints) {
  const SyntheticOptions options = small_scene("figure", 4);
  const SyntheticPath path = around(Shape::kArc, 20);
  const Photographs photographs = render(options, path);
  for (int i = 0; i < 4; ++i) {
    int figure = 0;
    for (int v = 0; v < options.height; ++v)
      for (int u = 0; u < options.width; ++u) {
        const float depth = photographs.depth[i](u, v);
        figure += std::isfinite(depth);
        if (std::isfinite(depth)) {
          EXPECT_GT(depth, 0.9);
          EXPECT_LT(depth, 2.3);
        } else {
          EXPECT_GT(depth, 0);
        }
        const bool is_white =
            photographs.pictures[i](u, v, 0) == 255 && photographs.pictures[i](u, v, 2) == 255;
        EXPECT_TRUE(!is_white || std::isinf(depth));
      }
    EXPECT_GT(figure, 0.08 * options.width * options.height);
    EXPECT_LT(figure, 0.4 * options.width * options.height);
  }
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  EXPECT_GT(capture.points.size(), 200u);
  for (const auto& point : capture.points)
    EXPECT_LT((point.position - Eigen::Vector3d(0, 0, 1.6)).norm(), 0.8);
}

TEST(SyntheticCapture, TheFloorOfTheRoomReachesTheLowerBorder) {
  const SyntheticOptions options = small_scene("room", 3);
  const FloatMap depth = render(options, around(Shape::kArc, 2)).depth[1];
  const int last = options.height - 1;
  EXPECT_GT(depth(5, last), 1);
  EXPECT_LT(depth(5, last), 1.1);
  // Affine in inverse depth: a plane.
  const double step = 1 / depth(5, last) - 1 / depth(5, last - 1);
  for (int k = 0; k < 15; ++k)
    EXPECT_NEAR(1 / depth(5, last - k), 1 / depth(5, last) - k * step, 1e-5);
  EXPECT_GT(step * 15, 0.2) << "very slanted";
}

TEST(SyntheticCapture, LegsOfTheTableAreFourToSixPixelsWide) {
  SyntheticOptions options = small_scene("room", 3);
  options.width = 640;
  options.height = 480;
  options.samples = 1;
  const FloatMap depth = render(options, around(Shape::kArc, 2)).depth[1];
  // A row below the table's top and above its feet; behind it the room is farther.
  const int v = 300;
  constexpr float kBehind = 2.65f;
  int legs = 0, width = 0;
  for (int u = 320; u < 600; ++u) {
    const bool is_leg = depth(u, v) < kBehind;
    if (!is_leg && width > 0) {
      ++legs;
      EXPECT_GE(width, 4);
      EXPECT_LE(width, 6);
    }
    width = is_leg ? width + 1 : 0;
  }
  EXPECT_EQ(legs, 4);
}

TEST(SyntheticCapture, ExposuresVaryAsStatedAndScaleTheEncodedValues) {
  SyntheticPath path = path_of(Shape::kLine);
  path.exposure_noise = 0.5;
  const std::vector<double> exposures = describe_synthetic_capture(small(400), path).exposures;
  EXPECT_NEAR(rms(exposures), 0.5, 0.05);

  SyntheticOptions options = small(4);
  options.bit_depth = 16;
  const Photographs exposed = render(options, path);
  path.exposure_noise = 0;
  const Photographs plain = render(options, path);
  EXPECT_EQ(exposed.depth, plain.depth);
  const std::vector<double> unchanged = describe_synthetic_capture(options, path).exposures;
  EXPECT_EQ(unchanged, std::vector<double>(4, 0));
  for (int i = 0; i < 4; ++i) {
    const double gain = std::exp2(exposures[i] / 2.2);
    for (int v = 0; v < options.height; ++v)
      for (int u = 0; u < options.width; ++u) {
        const double wanted = std::min(65535.0, gain * plain.pictures[i](u, v, 1));
        ASSERT_NEAR(exposed.pictures[i](u, v, 1), wanted, 2);
      }
  }
}

TEST(SyntheticCapture, TheSameOptionsGiveTheSamePhotographs) {
  SyntheticPath path = path_of(Shape::kWalk);
  path.off_line = 0.02;
  const Photographs once = render(small(2), path), again = render(small(2), path);
  EXPECT_EQ(once.pictures, again.pictures);
  SyntheticOptions other = small(2);
  other.seed = 2;
  EXPECT_NE(once.pictures, render(other, path).pictures);
}

TEST(SyntheticCapture, ABadOptionIsNamedWithItsValue) {
  const auto expect = [](auto change, const std::string& field, const std::string& value) {
    SyntheticOptions options = small();
    SyntheticPath path;
    change(options, path);
    testing_support::expect_error(ErrorCode::kInvalidArgument, {field, value},
                                  [&] { describe_synthetic_capture(options, path); });
  };
  using O = SyntheticOptions;
  using P = SyntheticPath;
  expect([](O& o, P&) { o.views_t = 2; }, "views_t", "2");
  expect([](O& o, P&) { o.width = 3; }, "width", "3");
  expect([](O&, P& p) { p.extent = 0; }, "extent", "0");
  expect([](O&, P& p) { p.extent = std::nan(""); }, "extent", "nan");
  expect([](O&, P& p) { p.spacing_noise = -1; }, "spacing_noise", "-1");
  expect([](O&, P& p) { p.off_line = 1; }, "off_line", "1");
  expect([](O&, P& p) { p.rotation_noise = 90; }, "rotation_noise", "90");
  expect([](O&, P& p) { p.distortion = 0.5; }, "distortion", "0.5");
  expect([](O&, P& p) { p.exposure_noise = 2; }, "exposure_noise", "2");
  expect([](O&, P& p) { p.step = 21; }, "step", "21");
  expect([](O&, P& p) { p.step = -1; }, "step", "-1");
  expect([](O& o, P& p) { p.step = 20, o.views_s = 6; }, "step * (views_s - 1)", "100");
  expect([](O& o, P& p) { p.step = 20, o.views_s = 8, o.scene = "room"; }, "step", "140");
  expect([](O&, P& p) { p.step = 5, p.shape = Shape::kLine; }, "step", "line");
}

TEST(SyntheticCapture, AnErrorOfTheSinkStopsTheRun) {
  EXPECT_THROW(render_synthetic_capture(small(), {}, RunControl(),
                                        [](int, Image<std::uint16_t>, FloatMap) {
                                          throw Error(ErrorCode::kIo, "full");
                                        }),
               Error);
}

}  // namespace
}  // namespace gigaray
