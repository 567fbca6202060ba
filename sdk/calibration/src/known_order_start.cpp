// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/known_order_start.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

/// The way of a scene point through the pictures, from the first to the last that shows it.
struct Flow {
  Eigen::Vector2d from, to;  ///< directions
  double steps = 0;          ///< views between, > 0
  Eigen::Vector2d per_step() const { return (to - from) / steps; }
};

std::vector<Flow> flows_of(const RadialLens& lens, const std::vector<Track>& tracks) {
  std::vector<Flow> flows;
  for (const Track& track : tracks) {
    require_argument(!track.empty(), "tracks: one has no sightings");
    const auto [first, last] = std::minmax_element(
        track.begin(), track.end(),
        [](const Sighting& a, const Sighting& b) { return a.view_idx < b.view_idx; });
    if (first->view_idx == last->view_idx) continue;
    flows.push_back({lens.direction(first->pixel), lens.direction(last->pixel),
                     double(last->view_idx - first->view_idx)});
  }
  return flows;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + long(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Eigen::Vector2d median_flow(const std::vector<Flow>& flows) {
  std::vector<double> x, y;
  for (const Flow& flow : flows) {
    x.push_back(flow.per_step().x());
    y.push_back(flow.per_step().y());
  }
  return {median_of(std::move(x)), median_of(std::move(y))};
}

/// The epipole that all flows point to or from: n · e = 0 for the line n through both ends of each,
/// by weighted least squares that outliers lose weight in.
Eigen::Vector3d epipole(const std::vector<Flow>& flows, Eigen::Vector3d e) {
  constexpr int kIterations = 20;
  for (int i = 0; i < kIterations; ++i) {
    std::vector<Eigen::Vector3d> lines;
    std::vector<double> errors;
    for (const Flow& flow : flows) {
      lines.push_back(flow.from.homogeneous().cross(flow.to.homogeneous()));
      errors.push_back(std::abs(lines.back().dot(e)));
    }
    const double scale = std::max(1e-12, 2 * median_of(errors));
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double ratio = errors[k] / scale;
      sum += lines[k] * lines[k].transpose() / (1 + ratio * ratio);
    }
    const Eigen::Vector3d next =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
    e = next.dot(e) < 0 ? Eigen::Vector3d(-next) : next;
  }
  return e;
}

}  // namespace

Rail known_order_start(int num_views, const RadialLens& lens, const std::vector<Track>& tracks) {
  constexpr std::size_t kLeastTracks = 8;
  if (num_views < 3)
    throw Error(ErrorCode::kBadInput,
                "a rail needs 3 views or more, there are " + std::to_string(num_views));
  require_argument(lens.focal > 0 && std::isfinite(lens.focal), "lens.focal: must be above 0");
  const std::vector<Flow> flows = flows_of(lens, tracks);
  if (flows.size() < kLeastTracks)
    throw Error(ErrorCode::kBadInput, "the pictures share too few features (" +
                                          std::to_string(flows.size()) + ") to follow the camera");
  const Eigen::Vector2d flow = median_flow(flows);
  // Nobody moves by less than this from the first to the last picture of a rail.
  constexpr double kLeastFlowPx = 0.5;
  if (flow.norm() * lens.focal * (num_views - 1) < kLeastFlowPx)
    throw Error(ErrorCode::kBadInput,
                "what the pictures show does not move; a rail needs a camera that does");
  // What is before the camera moves against it.
  const Eigen::Vector3d towards(-flow.x(), -flow.y(), 0);

  Rail rail;
  rail.lens = lens;
  rail.direction = epipole(flows, towards.normalized());
  // Unsteady rotations can hide the small angles between the flows that tell forward from sideways
  // motion. A rail goes sideways.
  constexpr double kMostForward = 0.7;
  if (std::abs(rail.direction.z()) > kMostForward || rail.direction.dot(towards) <= 0)
    rail.direction = towards.normalized();
  for (int i = 0; i < num_views; ++i) rail.positions.push_back(i - (num_views - 1) / 2.0);
  rail.turns.assign(std::size_t(num_views), Eigen::Matrix3d::Identity());
  return rail;
}

}  // namespace gigaray
