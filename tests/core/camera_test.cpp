// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "gigaray/core/light_field.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using Eigen::Vector3d;
using testing_support::expect_error;

Camera turned_camera() {
  Camera camera;
  camera.width = 93;
  camera.height = 61;
  camera.focal_u = 80;
  camera.focal_v = 82;
  camera.centre_u = 45.5;
  camera.centre_v = 31;
  camera.rotation = Eigen::AngleAxisd(0.3, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  camera.translation = {0.4, -1, 2};
  return camera;
}

TEST(Camera, AKnownPointIsSeenInItsPixel) {
  Camera camera;
  camera.width = camera.height = 100;
  camera.focal_u = 50;
  camera.focal_v = 60;
  camera.centre_u = 40;
  camera.centre_v = 30;
  camera.translation = {0, 0, 1};  // stands at (0, 0, -1)
  EXPECT_EQ(camera.position(), Vector3d(0, 0, -1));
  EXPECT_EQ(camera.direction(), Vector3d(0, 0, 1));
  // Right of and below the axis, 5 before the camera.
  EXPECT_TRUE(camera.project({1, 2, 4}).isApprox(Vector3d(40 + 50 * 0.2, 30 + 60 * 0.4, 5), 1e-12));
}

TEST(Camera, BackProjectionIsTheInverse) {
  const Camera camera = turned_camera();
  for (const Vector3d& seen : {Vector3d(3, 60, 0.5), Vector3d(92, -5, 7), Vector3d(45.5, 31, 100)})
    EXPECT_TRUE(
        camera.project(camera.back_project(seen.x(), seen.y(), seen.z())).isApprox(seen, 1e-12));
}

TEST(Camera, SeesWhatIsBeforeItAndInsideItsPicture) {
  const Camera camera = turned_camera();
  EXPECT_TRUE(camera.sees(camera.back_project(0.01, 0.01, 2)));
  EXPECT_TRUE(camera.sees(camera.back_project(91.99, 59.99, 2)));
  EXPECT_FALSE(camera.sees(camera.back_project(92.01, 30, 2)));
  EXPECT_FALSE(camera.sees(camera.back_project(40, -0.01, 2)));
  EXPECT_FALSE(camera.sees(camera.position() - camera.direction()));
}

TEST(Camera, WhatIsNoCameraIsNamed) {
  const auto expect_bad = [](const std::string& word, const std::function<void(Camera&)>& change) {
    Camera camera = turned_camera();
    change(camera);
    expect_error(ErrorCode::kBadInput, {"view_7", word}, [&] { check(camera, "view_7"); });
  };
  EXPECT_NO_THROW(check(turned_camera(), "view_7"));
  expect_bad("not a finite number", [](Camera& c) { c.centre_u = std::nan(""); });
  expect_bad("not finite", [](Camera& c) { c.translation.y() = INFINITY; });
  expect_bad("empty", [](Camera& c) { c.height = 0; });
  expect_bad("not positive", [](Camera& c) { c.focal_v = -82; });
  expect_bad("mirrored", [](Camera& c) { c.rotation.row(0) *= -1; });
  expect_bad("orthonormal", [](Camera& c) { c.rotation *= 1.01; });
  expect_bad("range", [](Camera& c) { c.inverse_depth = InverseDepthRange{0.5, 0.5}; });
}

TEST(InverseDepths, OfPointsAreRobustAndWidened) {
  std::vector<double> depths;
  for (int i = 0; i <= 1000; ++i) depths.push_back(1 / (0.1 + 0.1 * i / 1000));  // 5 … 10
  depths.push_back(1e-3);
  depths.push_back(1e6);
  const auto range = range_of_depths(depths);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->min, 0.1 - 0.2 * 0.1, 0.002);
  EXPECT_NEAR(range->max, 0.2 + 0.2 * 0.1, 0.002);
  EXPECT_FALSE(range_of_depths(std::vector<double>(7, 3.0)));
  // Points at one depth still leave something to search; nothing is beyond infinity.
  const auto flat = range_of_depths(std::vector<double>(8, 4.0));
  ASSERT_TRUE(flat);
  EXPECT_LT(flat->min, 0.25);
  EXPECT_GT(flat->max, 0.25);
  EXPECT_EQ(widened({0, 1}).min, 0);
}

TEST(InverseDepths, InfinityIsSearchedOnlyWherePointsAreAsFar) {
  // Depths 1 … 10: a fifth of the inverse depths more would hold infinity.
  const InverseDepthRange deep = widened({0.1, 1});
  EXPECT_NEAR(1 / deep.min, 15, 1e-9);
  EXPECT_NEAR(deep.max, 1.18, 1e-9);
  const InverseDepthRange narrow = widened({0.4, 0.5});
  EXPECT_NEAR(narrow.min, 0.38, 1e-9);
  EXPECT_NEAR(narrow.max, 0.52, 1e-9);
  EXPECT_EQ(widened({0.009, 1}).min, 0);
  EXPECT_GT(widened({0.011, 1}).min, 0);
}

TEST(PlaceByCameras, StepsAreThoseToTheNearestNeighbour) {
  LightField light_field;
  for (int i = 0; i < 4; ++i) {
    Camera camera = turned_camera();
    camera.translation = -camera.rotation * Vector3d(2, 0.5 * i, -1);
    light_field.cameras.push_back(camera);
    light_field.views.push_back({"v" + std::to_string(i), 0, 0});
  }
  EXPECT_NEAR(place_by_cameras(light_field), 0.5, 1e-12);
  double length = 0;
  for (int i = 1; i < 4; ++i)
    length += std::hypot(light_field.views[i].s - light_field.views[i - 1].s,
                         light_field.views[i].t - light_field.views[i - 1].t);
  EXPECT_NEAR(length, 3, 1e-9);
  for (Camera& camera : light_field.cameras) camera = light_field.cameras[0];
  expect_error(ErrorCode::kBadInput, {}, [&] { place_by_cameras(light_field); });
}

}  // namespace
}  // namespace gigaray
