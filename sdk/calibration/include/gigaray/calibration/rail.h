// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// A scene point in one picture.
struct Sighting {
  int view_idx = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< pixel centres at integers
};

/// One scene point followed through pictures: two sightings or more, no view twice.
using Track = std::vector<Sighting>;

/// A lens with radial distortion, COLMAP's model RADIAL with pixel centres at integers: a direction
/// (x / z, y / z) = x is seen at focal · (1 + k1 r² + k2 r⁴) · x + centre, with r = |x|.
struct RadialLens {
  double focal = 0;                                  ///< px
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< px
  double k1 = 0, k2 = 0;

  Eigen::Vector2d project(const Eigen::Vector2d& direction) const;
  /// Is the direction within the radius up to which the picture grows? Beyond, it would fold back.
  bool sees(const Eigen::Vector2d& direction) const;
  /// The inverse of project(), as near as iterations come to it.
  Eigen::Vector2d direction(const Eigen::Vector2d& pixel) const;
};

/// Cameras on a line, all with one lens.
struct Rail {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< scene → camera, common to all
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();    ///< unit, scene frame
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();        ///< on the line, scene units
  std::vector<double> positions;                           ///< of the views, scene units
  /// What the rail's unsteadiness adds to the common rotation: common frame → camera, one per view.
  std::vector<Eigen::Matrix3d> turns;
  RadialLens lens;

  int num_views() const { return int(positions.size()); }
  Eigen::Vector3d centre(int view_idx) const { return origin + positions[view_idx] * direction; }
  /// scene → camera
  Eigen::Matrix3d view_rotation(int view_idx) const { return turns[view_idx] * rotation; }
};

/// A scene point by its direction (a, b, 1) from the origin of a rail, in the common frame of the
/// cameras, and its inverse depth there: far points are as well behaved as near ones.
struct RailPoint {
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  double inverse_depth = 0;  ///< 1 / scene unit
};

/// Where a view of the rail sees the point, px. The point is before the camera.
Eigen::Vector2d project(const Rail& rail, int view_idx, const RailPoint& point);

/// The point of least squares from its sightings. Noise can give a far one a negative inverse
/// depth.
RailPoint triangulate(const Rail& rail, const Track& track);

/// How far sightings are from where the rail sees their points, px.
struct ResidualStats {
  long count = 0;
  double rms = 0;
  double median = 0;
  double percentile_95 = 0;
};

/// Of lengths, px; zeros for none.
ResidualStats residual_stats(std::vector<double> lengths);

}  // namespace gigaray
