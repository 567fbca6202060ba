// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/synthetic_capture.h"

#include <gtest/gtest.h>

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
