// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <vector>

#include "gigaray/calibration/rail.h"
#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// What the adjustment may move, and what it does about wrong tracks.
struct RailAdjustmentOptions {
  /// Every camera gets a rotation of its own, held near the common one by rotation_sigma_deg. Off:
  /// one rotation for all, Rail::turns stay as they are.
  bool own_rotations = false;
  /// Expected unsteadiness of the rotation, degrees. It only decides what the pictures leave open,
  /// as whether all cameras turned or moved.
  double rotation_sigma_deg = 1;
  /// Keeps, with own_rotations, how the turns of the start change along the rail on the whole. To
  /// first order such a change can't be told from a shift of all inverse depths; cameras that stand
  /// a little beside the line make the pictures tell it wrongly.
  bool hold_turn_trend = false;
  /// Expected distance of the cameras from the line, of the mean step; they may leave it then,
  /// which finds the turns without that error. 0: all stand on it. The result has no such
  /// distances.
  double off_line_sigma = 0;
  /// Seen by cameras that turn or by a bundle of other than parallel views only: with common
  /// rotations the focal length can't be told from the depth of the scene.
  bool refine_focal = false;
  bool refine_centre = false;      ///< principal point
  bool refine_distortion = false;  ///< k1, k2
  /// Scale of the Cauchy loss, px: sightings beyond it count less and less.
  double loss_px = 1;
  int max_iterations = 60;
  int num_threads = 0;  ///< 0: those of parallel.h
};

/// A rail that fits its tracks.
struct RailAdjustment {
  Rail rail;
  /// Of the tracks, in their order; empty where a track contradicts the rail.
  std::vector<std::optional<RailPoint>> points;
  ResidualStats before;         ///< of all sightings, with the rail as it was
  ResidualStats after;          ///< of the sightings that were kept
  long num_sightings = 0;       ///< of all tracks
  long rejected_sightings = 0;  ///< that contradict the rail
};

/// Bundle adjustment of cameras that stand on one line: the line's direction, the position of every
/// camera on it, the points and what `options` name are moved until the sightings of the tracks are
/// matched best. The common rotation, the origin and the positions of the two outermost views are
/// held, as pictures don't tell them. Throws Error(kBadInput) for fewer than 3 views, a view that
/// too few tracks reach, numbers that are not finite, and when no solution is found.
RailAdjustment adjust_rail(const Rail& start, const std::vector<Track>& tracks,
                           const RailAdjustmentOptions& options, const RunControl& control);

}  // namespace gigaray
