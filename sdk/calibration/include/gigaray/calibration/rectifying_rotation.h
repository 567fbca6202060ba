// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "gigaray/calibration/rail.h"
#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"

namespace GIGARAY_API gigaray {

/// Rotation (scene → camera) of all cameras of a rail after rectification (Fusiello et al. 2000,
/// "A compact algorithm for rectification of stereo pairs"): x along the rail, the view direction
/// changed as little as possible. x goes the way that is right in the pictures; of a rail that goes
/// up or down in them, the way that is down, which turns the pictures by a right angle. Throws
/// Error(kBadInput) when the cameras look along the rail, within 30 degrees.
Eigen::Matrix3d rectifying_rotation(const Eigen::Matrix3d& common_rotation,
                                    const Eigen::Vector3d& rail_direction);

/// Pixels of a camera → pixels of another one at the same place, homogeneous.
Eigen::Matrix3d homography_between(const Camera& from, const Camera& to);

/// Positions of views along the x axis of a rectified camera: greater further to the right.
std::vector<double> rectified_positions(const Rail& rail, const Eigen::Matrix3d& rectified);

/// Columns and rows [u, u + width) × [v, v + height).
struct PixelRectangle {
  int u = 0, v = 0, width = 0, height = 0;
};

/// The largest rectangle of pixels inside of `bounds` that are all valid, found on a raster of
/// every `step` pixels: between two neighbours of the raster that are valid all pixels count as
/// valid. Empty when none is.
std::optional<PixelRectangle> largest_valid_rectangle(
    const PixelRectangle& bounds, int step, const std::function<bool(int u, int v)>& valid);

/// The tracks as the rectified camera sees them from the places of the views: lens and turns of the
/// rail undone.
std::vector<Track> rectified_tracks(const Rail& rail, const Camera& rectified,
                                    const std::vector<Track>& tracks);

/// |v − v′| of the sightings of a track in successive views of its order: 0 when rows are epipolar
/// lines. px.
ResidualStats vertical_residual(const std::vector<Track>& tracks);

}  // namespace gigaray
