// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rectifying_rotation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {

Eigen::Matrix3d rectifying_rotation(const Eigen::Matrix3d& common_rotation,
                                    const Eigen::Vector3d& rail_direction) {
  require_argument(
      common_rotation.allFinite() && rail_direction.allFinite() && rail_direction.norm() > 0,
      "common_rotation, rail_direction: finite numbers are needed, a direction that is not 0");
  constexpr double kLeastAngleDeg = 30;
  Eigen::Vector3d x = rail_direction.normalized();
  const Eigen::Vector3d view = common_rotation.row(2).transpose();
  if (std::abs(view.dot(x)) > std::cos(kLeastAngleDeg * std::numbers::pi / 180))
    throw Error(ErrorCode::kBadInput,
                "the cameras look along their way; a rail has to go sideways, for other ways use "
                "gigaray depth on the photographs");
  const Eigen::Vector3d seen = common_rotation * x;
  const bool sideways = std::abs(seen.x()) >= std::abs(seen.y());
  if ((sideways ? seen.x() : seen.y()) < 0) x = -x;
  const Eigen::Vector3d y = view.cross(x).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = x.transpose();
  rotation.row(1) = y.transpose();
  rotation.row(2) = x.cross(y).transpose();
  return rotation;
}

namespace {

Eigen::Matrix3d pinhole_matrix(const Camera& camera) {
  Eigen::Matrix3d matrix;
  matrix << camera.focal_u, 0, camera.centre_u, 0, camera.focal_v, camera.centre_v, 0, 0, 1;
  return matrix;
}

}  // namespace

Eigen::Matrix3d homography_between(const Camera& from, const Camera& to) {
  return pinhole_matrix(to) * to.rotation * from.rotation.transpose() *
         pinhole_matrix(from).inverse();
}

std::vector<double> rectified_positions(const Rail& rail, const Eigen::Matrix3d& rectified) {
  std::vector<double> positions;
  for (int view = 0; view < rail.num_views(); ++view)
    positions.push_back(rectified.row(0).dot(rail.centre(view)));
  return positions;
}

std::vector<Track> rectified_tracks(const Rail& rail, const Camera& rectified,
                                    const std::vector<Track>& tracks) {
  std::vector<Track> result = tracks;
  for (Track& track : result)
    for (Sighting& sighting : track) {
      require_argument(
          sighting.view_idx >= 0 &&
              std::size_t(sighting.view_idx) < std::min(rail.positions.size(), rail.turns.size()),
          "tracks: a sighting is of a view that is not there");
      const Eigen::Vector3d ray = rectified.rotation *
                                  rail.view_rotation(sighting.view_idx).transpose() *
                                  rail.lens.direction(sighting.pixel).homogeneous();
      sighting.pixel = {rectified.focal_u * ray.x() / ray.z() + rectified.centre_u,
                        rectified.focal_v * ray.y() / ray.z() + rectified.centre_v};
    }
  return result;
}

ResidualStats vertical_residual(const std::vector<Track>& tracks) {
  std::vector<double> lengths;
  for (const Track& track : tracks)
    for (std::size_t i = 1; i < track.size(); ++i)
      lengths.push_back(std::abs(track[i].pixel.y() - track[i - 1].pixel.y()));
  return residual_stats(std::move(lengths));
}

}  // namespace gigaray
