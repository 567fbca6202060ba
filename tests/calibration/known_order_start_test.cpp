// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/known_order_start.h"

#include <gtest/gtest.h>

#include "gigaray/calibration/rail_adjustment.h"
#include "rail_scene.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace testing_support;

double angle_to(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return degrees(std::acos(std::min(1.0, a.normalized().dot(b.normalized()))));
}

TEST(KnownOrderStart, SteadyRailGivesItsDirectionAndOrder) {
  for (const Eigen::Vector3d& travel : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0.1, 0.2),
                                        Eigen::Vector3d(0, 1, 0.1), Eigen::Vector3d(0.9, 0, 0.4)}) {
    RailSceneOptions options;
    options.travel = travel.normalized();
    const RailScene scene = make_rail_scene(options);
    const Rail start = known_order_start(15, options.lens, scene.tracks);
    EXPECT_LT(angle_to(start.direction, travel), 0.01) << travel.transpose();
    EXPECT_LT(position_error(start, scene.rail), 1e-9);
  }
}

TEST(KnownOrderStart, LeadsTheAdjustmentToTheRail) {
  RailSceneOptions options;
  options.spacing = 0.1;
  options.turn_deg = 0.3;
  options.noise_px = 0.3;
  options.outliers = 0.1;
  const RailScene scene = make_rail_scene(options);
  const Rail start = known_order_start(15, options.lens, scene.tracks);
  RailAdjustmentOptions own;
  own.own_rotations = true;
  const RailAdjustment result = adjust_rail(start, scene.tracks, own, RunControl());
  EXPECT_LT(result.after.rms, 0.45);
  EXPECT_LT(position_error(result.rail, scene.rail), 0.05);
  EXPECT_LT(angle_to(result.rail.direction, options.travel), 2);
}

TEST(KnownOrderStart, PicturesThatDontMoveAreRefused) {
  RailSceneOptions options;
  options.num_views = 5;
  RailScene scene = make_rail_scene(options);
  for (Track& track : scene.tracks)
    for (Sighting& sighting : track) sighting.pixel = track.front().pixel;
  expect_error(ErrorCode::kBadInput, {"does not move"},
               [&] { known_order_start(5, options.lens, scene.tracks); });
  expect_error(ErrorCode::kBadInput, {"too few features"},
               [&] { known_order_start(5, options.lens, {}); });
}

}  // namespace
}  // namespace gigaray
