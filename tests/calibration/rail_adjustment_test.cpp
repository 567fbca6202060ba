// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rail_adjustment.h"

#include <gtest/gtest.h>

#include <limits>

#include "rail_scene.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace testing_support;

const RunControl kQuiet;

TEST(RailAdjustment, ExactSightingsGiveTheRailExactly) {
  RailSceneOptions options;
  options.spacing = 0.1;
  const RailScene scene = make_rail_scene(options);
  const RailAdjustment result = adjust_rail(ideal_start(scene.rail), scene.tracks, {}, kQuiet);
  EXPECT_GT(result.before.rms, 1);
  EXPECT_LT(result.after.rms, 1e-6);
  EXPECT_EQ(result.rejected_sightings, 0);
  EXPECT_LT(position_error(result.rail, scene.rail), 1e-6);
  EXPECT_LT((result.rail.direction - scene.rail.direction).norm(), 1e-8);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    ASSERT_TRUE(result.points[i]);
    const Eigen::Vector3d point =
        scene.rail.origin + scene.rail.rotation.transpose() *
                                result.points[i]->direction.homogeneous() /
                                result.points[i]->inverse_depth;
    EXPECT_LT((point - scene.points[i]).norm(), 1e-5);
  }
}

TEST(RailAdjustment, EveryCamerasOwnTurnIsFound) {
  RailSceneOptions options;
  options.spacing = 0.1;
  options.turn_deg = 0.3;
  const RailScene scene = make_rail_scene(options);
  RailAdjustmentOptions own;
  own.own_rotations = true;
  const RailAdjustment result = adjust_rail(ideal_start(scene.rail), scene.tracks, own, kQuiet);
  // The expectation of small turns weighs less than a thousandth of what the pictures say.
  EXPECT_LT(result.after.rms, 1e-2);
  const Eigen::Matrix3d first =
      result.rail.view_rotation(0) * scene.rail.view_rotation(0).transpose();
  for (int view = 1; view < scene.rail.num_views(); ++view)
    EXPECT_LT(
        angle_between(result.rail.view_rotation(view), first * scene.rail.view_rotation(view)),
        0.02);
}

TEST(RailAdjustment, NoiseAndWrongTracksDoLittleHarm) {
  RailSceneOptions options;
  options.spacing = 0.1;
  options.turn_deg = 0.3;
  options.noise_px = 0.3;
  options.outliers = 0.1;
  const RailScene scene = make_rail_scene(options);
  RailAdjustmentOptions own;
  own.own_rotations = true;
  const RailAdjustment result = adjust_rail(ideal_start(scene.rail), scene.tracks, own, kQuiet);
  // 0.3 px in each of two axes.
  EXPECT_LT(result.after.rms, 0.45);
  EXPECT_GT(result.after.rms, 0.35);
  EXPECT_LT(position_error(result.rail, scene.rail), 0.05);
  const double share = double(result.rejected_sightings) / double(result.num_sightings);
  EXPECT_GT(share, 0.07);
  EXPECT_LT(share, 0.13);
}

TEST(RailAdjustment, DistortionIsFound) {
  RailSceneOptions options;
  options.lens.k1 = -0.1;
  options.lens.k2 = 0.02;
  options.noise_px = 0.3;
  const RailScene scene = make_rail_scene(options);
  Rail start = ideal_start(scene.rail);
  start.lens.k1 = start.lens.k2 = 0;
  RailAdjustmentOptions refine;
  refine.refine_distortion = true;
  const RailAdjustment result = adjust_rail(start, scene.tracks, refine, kQuiet);
  EXPECT_NEAR(result.rail.lens.k1, -0.1, 0.01);
  EXPECT_NEAR(result.rail.lens.k2, 0.02, 0.02);
  EXPECT_EQ(result.rail.lens.focal, scene.rail.lens.focal);
  EXPECT_LT(result.after.rms, 0.45);
}

TEST(RailAdjustment, CamerasBesideTheLineLeaveAResidualOfThatSize) {
  RailSceneOptions options;
  options.off_line = 0.02;
  const RailScene scene = make_rail_scene(options);
  const RailAdjustment result = adjust_rail(ideal_start(scene.rail), scene.tracks, {}, kQuiet);
  // 2 % of a step of 0.03 at a depth of 2 … 10 seen with 800 px.
  EXPECT_LT(result.after.rms, 0.02 * 0.03 / 2 * 800 * 1.5);
  EXPECT_GT(result.after.rms, 0.02 * 0.03 / 10 * 800 / 1.5);
}

/// By how much more than in truth the cameras turn from one end of the rail to the other, degrees.
double trend_error(const Rail& rail, const Rail& truth) {
  double squares = 0;
  for (const double position : truth.positions) squares += position * position;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (int view = 0; view < rail.num_views(); ++view) {
    const Eigen::AngleAxisd more(rail.turns[view] * truth.turns[view].transpose());
    slope += truth.positions[view] / squares * more.angle() * more.axis();
  }
  return degrees(slope.norm() * (truth.positions.back() - truth.positions.front()));
}

TEST(RailAdjustment, CamerasBesideTheLineTellTheTurnsWronglyUnlessTheyMayLeaveIt) {
  RailSceneOptions options;
  options.off_line = 0.06;
  options.turn_deg = 0.3;
  options.noise_px = 0.2;
  const RailScene scene = make_rail_scene(options);
  RailAdjustmentOptions on_line;
  on_line.own_rotations = true;
  const Rail biased = adjust_rail(ideal_start(scene.rail), scene.tracks, on_line, kQuiet).rail;
  RailAdjustmentOptions free = on_line;
  free.off_line_sigma = 0.1;
  const Rail better = adjust_rail(ideal_start(scene.rail), scene.tracks, free, kQuiet).rail;
  EXPECT_LT(trend_error(better, scene.rail), 0.5 * trend_error(biased, scene.rail));

  RailAdjustmentOptions hold = on_line;
  hold.hold_turn_trend = true;
  const Rail held = adjust_rail(better, scene.tracks, hold, kQuiet).rail;
  EXPECT_NEAR(trend_error(held, better), 0, 0.01);
}

TEST(RailAdjustment, WhatCantBeARailIsRefused) {
  const RailScene scene = make_rail_scene({});
  Rail two = scene.rail;
  two.positions.resize(2);
  two.turns.resize(2);
  expect_error(ErrorCode::kBadInput, {"3 views"}, [&] { adjust_rail(two, {}, {}, kQuiet); });

  std::vector<Track> without_last = scene.tracks;
  for (Track& track : without_last)
    std::erase_if(track, [](const Sighting& sighting) { return sighting.view_idx == 14; });
  expect_error(ErrorCode::kBadInput, {"view 14", "too few"},
               [&] { adjust_rail(scene.rail, without_last, {}, kQuiet); });

  std::vector<Track> broken = scene.tracks;
  broken[3][0].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  expect_error(ErrorCode::kBadInput, {"finite"},
               [&] { adjust_rail(scene.rail, broken, {}, kQuiet); });
}

TEST(RailAdjustment, StopsWhenAsked) {
  const RailScene scene = make_rail_scene({});
  RunControl stopped;
  stopped.cancel();
  expect_error(ErrorCode::kCancelled, {},
               [&] { adjust_rail(scene.rail, scene.tracks, {}, stopped); });
}

}  // namespace
}  // namespace gigaray
