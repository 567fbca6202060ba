// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "gigaray/calibration/rail.h"

namespace gigaray::testing_support {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }
inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Angle between two rotations, degrees.
inline double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return degrees(Eigen::AngleAxisd(a * b.transpose()).angle());
}

/// A rail that is not perfect, before a cloud of points.
struct RailSceneOptions {
  int num_views = 15;
  int num_points = 400;
  double turn_deg = 0;  ///< standard deviation per axis
  double spacing = 0;   ///< of the step
  double off_line = 0;  ///< of the step, across the rail
  double noise_px = 0;
  double outliers = 0;  ///< share of tracks whose sightings are anywhere
  Eigen::Vector3d travel = Eigen::Vector3d(1, 0.05, -0.1).normalized();  ///< camera frame
  RadialLens lens{800, {479.5, 319.5}, 0, 0};
};

struct RailScene {
  Rail rail;  ///< the truth; its direction is the mean one when the cameras are off the line
  std::vector<Eigen::Vector3d> centres;
  std::vector<Eigen::Vector3d> points;  ///< scene frame, one per track
  std::vector<Track> tracks;
};

/// Steps are about 0.03 scene units, points 2 … 10 before the camera. The scene frame is turned
/// against that of the cameras. Same seed, same scene.
inline RailScene make_rail_scene(const RailSceneOptions& options, unsigned seed = 7) {
  constexpr double kStep = 0.03;
  constexpr double kWidth = 960, kHeight = 640;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);

  RailScene scene;
  Rail& rail = scene.rail;
  rail.lens = options.lens;
  rail.rotation = (Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  rail.direction = rail.rotation.transpose() * options.travel;
  rail.origin = {3, -2, 5};
  for (int view = 0; view < options.num_views; ++view) {
    const bool inside = view > 0 && view < options.num_views - 1;
    rail.positions.push_back(kStep * (view - (options.num_views - 1) / 2.0 +
                                      (inside ? options.spacing * normal(random) : 0)));
    const Eigen::Vector3d turn =
        radians(options.turn_deg) * Eigen::Vector3d(normal(random), normal(random), normal(random));
    rail.turns.push_back(turn.norm() > 0
                             ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                             : Eigen::Matrix3d::Identity());
    const Eigen::Vector3d away(normal(random), normal(random), normal(random));
    const Eigen::Vector3d across = away - rail.direction.dot(away) * rail.direction;
    scene.centres.push_back(rail.centre(view) + options.off_line * kStep * across);
  }
  while (int(scene.points.size()) < options.num_points) {
    const Eigen::Vector2d pixel(uniform(random) * kWidth, uniform(random) * kHeight);
    const double depth = 1 / (0.1 + 0.4 * uniform(random));
    const Eigen::Vector3d point =
        rail.origin +
        rail.rotation.transpose() * (depth * rail.lens.direction(pixel).homogeneous());
    Track track;
    for (int view = 0; view < options.num_views; ++view) {
      const Eigen::Vector3d ray = rail.view_rotation(view) * (point - scene.centres[view]);
      Eigen::Vector2d seen = rail.lens.project(ray.hnormalized());
      seen += options.noise_px * Eigen::Vector2d(normal(random), normal(random));
      if (seen.x() >= 0 && seen.x() < kWidth && seen.y() >= 0 && seen.y() < kHeight)
        track.push_back({view, seen});
    }
    if (track.size() < 3) continue;
    if (uniform(random) < options.outliers)
      for (Sighting& sighting : track)
        sighting.pixel = {uniform(random) * kWidth, uniform(random) * kHeight};
    scene.points.push_back(point);
    scene.tracks.push_back(std::move(track));
  }
  return scene;
}

/// The rail as a program without knowledge would assume it: equal steps, straight along x of a
/// camera that does not turn.
inline Rail ideal_start(const Rail& truth) {
  Rail start = truth;
  start.direction = truth.rotation.row(0).transpose();
  for (std::size_t i = 0; i < start.positions.size(); ++i) {
    const double share = double(i) / double(start.positions.size() - 1);
    start.positions[i] =
        truth.positions.front() + share * (truth.positions.back() - truth.positions.front());
    start.turns[i].setIdentity();
  }
  return start;
}

/// Largest difference of positions of two rails, in steps, after moving and scaling one so that the
/// outermost views agree.
inline double position_error(const Rail& rail, const Rail& truth) {
  const auto share = [](const Rail& r, std::size_t i) {
    return (r.positions[i] - r.positions.front()) / (r.positions.back() - r.positions.front());
  };
  double worst = 0;
  for (std::size_t i = 0; i < truth.positions.size(); ++i)
    worst = std::max(
        worst, std::abs(share(rail, i) - share(truth, i)) * double(truth.positions.size() - 1));
  return worst;
}

}  // namespace gigaray::testing_support
