// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rectifying_rotation.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "rail_scene.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace testing_support;

Camera rectified_camera(const Rail& rail) {
  Camera camera;
  camera.width = 960;
  camera.height = 640;
  camera.focal_u = camera.focal_v = rail.lens.focal;
  camera.centre_u = rail.lens.centre.x();
  camera.centre_v = rail.lens.centre.y();
  camera.rotation = rectifying_rotation(rail.rotation, rail.direction);
  return camera;
}

TEST(RectifyingRotation, EpipolarLinesBecomeRows) {
  RailSceneOptions options;
  options.turn_deg = 0.5;
  options.spacing = 0.1;
  options.lens.k1 = -0.1;
  const RailScene scene = make_rail_scene(options);
  EXPECT_GT(vertical_residual(scene.tracks).median, 1);
  const std::vector<Track> tracks =
      rectified_tracks(scene.rail, rectified_camera(scene.rail), scene.tracks);
  EXPECT_LT(vertical_residual(tracks).rms, 1e-6);
}

TEST(RectifyingRotation, NearPointsMoveLeftAsPositionsRise) {
  for (const double way : {1.0, -1.0}) {
    RailSceneOptions options;
    options.travel = Eigen::Vector3d(way, 0.1, 0).normalized();
    const RailScene scene = make_rail_scene(options);
    const Camera camera = rectified_camera(scene.rail);
    const std::vector<double> s = rectified_positions(scene.rail, camera.rotation);
    EXPECT_EQ(s.back() > s.front(), way > 0);
    for (const Track& track : rectified_tracks(scene.rail, camera, scene.tracks)) {
      const double moved = track.back().pixel.x() - track.front().pixel.x();
      EXPECT_LT(moved * (s[track.back().view_idx] - s[track.front().view_idx]), 0);
    }
  }
}

TEST(RectifyingRotation, SteadyCameraAlongItsRowsKeepsItsRotation) {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const double way : {1.0, -1.0})
    EXPECT_LT((rectifying_rotation(rotation, way * rotation.row(0).transpose()) - rotation).norm(),
              1e-12);
}

TEST(RectifyingRotation, ViewDirectionChangesOnlyAlongTheRail) {
  const Eigen::Matrix3d rectified = rectifying_rotation(Eigen::Matrix3d::Identity(), {1, 0.2, 0.1});
  EXPECT_NEAR(rectified.determinant(), 1, 1e-12);
  // The old view direction lies in the plane of the rail and the new one.
  EXPECT_NEAR(rectified.row(1).dot(Eigen::Vector3d::UnitZ()), 0, 1e-12);
  EXPECT_GT(rectified.row(2).dot(Eigen::Vector3d::UnitZ()), 0.9);
}

TEST(RectifyingRotation, RailThatGoesDownTurnsThePicture) {
  const Eigen::Matrix3d rectified = rectifying_rotation(Eigen::Matrix3d::Identity(), {0, -1, 0});
  EXPECT_LT((rectified.row(0).transpose() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((rectified.row(1).transpose() + Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST(RectifyingRotation, LookingAlongTheRailIsRefused) {
  expect_error(ErrorCode::kBadInput, {"along their way", "gigaray depth"}, [] {
    rectifying_rotation(Eigen::Matrix3d::Identity(), {0.1, 0, 1});
  });
}

TEST(Homography, MapsWhatOneCameraSeesToWhatTheOtherSees) {
  Camera a;
  a.width = a.height = 100;
  a.focal_u = 90;
  a.focal_v = 95;
  a.centre_u = 50;
  a.centre_v = 45;
  Camera b = a;
  b.focal_u = b.focal_v = 120;
  b.rotation = Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix();
  const Eigen::Vector3d point(0.3, -0.2, 4);
  const Eigen::Vector3d seen_a = a.project(point), seen_b = b.project(point);
  const Eigen::Vector3d mapped =
      homography_between(a, b) * Eigen::Vector3d(seen_a.x(), seen_a.y(), 1);
  EXPECT_LT((mapped.hnormalized() - seen_b.head<2>()).norm(), 1e-9);
}

TEST(ValidRectangle, IsTheLargestOne) {
  // Valid: an L of a wide foot and a high stem.
  const auto valid = [](int u, int v) { return v >= 60 || u < 20; };
  const auto rectangle = largest_valid_rectangle({0, 0, 101, 101}, 1, valid);
  ASSERT_TRUE(rectangle);
  EXPECT_EQ(rectangle->u, 0);
  EXPECT_EQ(rectangle->v, 60);
  EXPECT_EQ(rectangle->width, 101);
  EXPECT_EQ(rectangle->height, 41);
}

TEST(ValidRectangle, RasterKeepsInsideOfWhatIsValid) {
  const auto valid = [](int u, int v) { return u > -7 && u < 93 && v > 5; };
  const auto rectangle = largest_valid_rectangle({-20, -20, 144, 93}, 4, valid);
  ASSERT_TRUE(rectangle);
  EXPECT_GT(rectangle->u, -7);
  EXPECT_LT(rectangle->u + rectangle->width - 1, 93);
  EXPECT_GT(rectangle->v, 5);
  EXPECT_LE(rectangle->v + rectangle->height, 73);
  EXPECT_GE(rectangle->width, 92);
  EXPECT_FALSE(largest_valid_rectangle({0, 0, 9, 9}, 1, [](int, int) { return false; }));
}

}  // namespace
}  // namespace gigaray
