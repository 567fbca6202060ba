// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rail_adjustment.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "gigaray/core/parallel.h"

namespace gigaray {
namespace {

constexpr int kLeastSightings = 8;  // of a view

/// What the solver moves, as plain numbers.
struct Unknowns {
  Eigen::Vector3d travel;  ///< unit, common frame
  std::vector<double> positions;
  std::vector<Eigen::Vector3d> beside;  ///< of the cameras from the line, common frame
  std::vector<Eigen::Vector3d> turns;   ///< angle · axis
  std::vector<Eigen::Vector3d> points;  ///< a, b, inverse depth
  std::array<double, 3> pinhole{};      ///< focal, centre
  std::array<double, 2> distortion{};   ///< k1, k2
};

/// Distance of a sighting from where the rail sees its point, px.
struct Reprojection {
  Eigen::Vector2d pixel;

  template <class T>
  bool operator()(const T* travel, const T* position, const T* beside, const T* turn,
                  const T* point, const T* pinhole, const T* distortion, T* residual) const {
    const T common[3] = {point[0] - point[2] * (position[0] * travel[0] + beside[0]),
                         point[1] - point[2] * (position[0] * travel[1] + beside[1]),
                         T(1) - point[2] * (position[0] * travel[2] + beside[2])};
    T ray[3];
    ceres::AngleAxisRotatePoint(turn, common, ray);
    if (ray[2] <= T(1e-3)) return false;  // behind the camera
    const T x = ray[0] / ray[2], y = ray[1] / ray[2];
    const T r2 = x * x + y * y;
    const T scale = pinhole[0] * (T(1) + r2 * (distortion[0] + r2 * distortion[1]));
    residual[0] = scale * x + pinhole[1] - pixel.x();
    residual[1] = scale * y + pinhole[2] - pixel.y();
    return true;
  }
};

/// Holds a turn, or a place beside the line, near none.
struct Steadiness {
  double weight;

  template <class T>
  bool operator()(const T* deviation, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = weight * deviation[i];
    return true;
  }
};

/// Holds how the turns change along the rail, on the whole (the slope of a line through them).
class TurnTrend : public ceres::CostFunction {
 public:
  TurnTrend(const std::vector<double>& positions, const std::vector<Eigen::Vector3d>& turns)
      : weights_(positions.size()) {
    double mean = 0, squares = 0;
    for (const double position : positions) mean += position / double(positions.size());
    for (const double position : positions) squares += (position - mean) * (position - mean);
    const auto [first, last] = std::minmax_element(positions.begin(), positions.end());
    constexpr double kSigma = 1e-5;  // radians, from one end of the rail to the other
    for (std::size_t i = 0; i < positions.size(); ++i) {
      weights_[i] = (positions[i] - mean) / squares * (*last - *first) / kSigma;
      held_ += weights_[i] * turns[i];
      mutable_parameter_block_sizes()->push_back(3);
    }
    set_num_residuals(3);
  }

  bool Evaluate(const double* const* turns, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::Vector3d> residual(residuals);
    residual = -held_;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      residual += weights_[i] * Eigen::Map<const Eigen::Vector3d>(turns[i]);
      if (!jacobians || !jacobians[i]) continue;
      Eigen::Map<Eigen::Matrix3d> jacobian(jacobians[i]);
      jacobian = weights_[i] * Eigen::Matrix3d::Identity();
    }
    return true;
  }

 private:
  std::vector<double> weights_;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();
};

class StopWhenCancelled : public ceres::IterationCallback {
 public:
  explicit StopWhenCancelled(const RunControl& control) : control_(control) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return control_.cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const RunControl& control_;
};

class Adjuster {
 public:
  Adjuster(const Rail& start, const std::vector<Track>& tracks,
           const RailAdjustmentOptions& options, const RunControl& control)
      : start_(start), tracks_(tracks), options_(options), control_(control) {
    unknowns_.travel = start.rotation * start.direction;
    unknowns_.positions = start.positions;
    unknowns_.beside.assign(start.positions.size(), Eigen::Vector3d::Zero());
    for (const Eigen::Matrix3d& turn : start.turns) {
      const Eigen::AngleAxisd angle_axis(turn);
      unknowns_.turns.push_back(angle_axis.angle() * angle_axis.axis());
    }
    start_turns_ = unknowns_.turns;
    const RadialLens& lens = start.lens;
    unknowns_.pinhole = {lens.focal, lens.centre.x(), lens.centre.y()};
    unknowns_.distortion = {lens.k1, lens.k2};
    for (const Track& track : tracks) {
      const RailPoint point = triangulate(start, track);
      unknowns_.points.push_back(point.direction.homogeneous());
      unknowns_.points.back().z() = point.inverse_depth;
      keep_.emplace_back(track.size(), true);
      is_held_.push_back(true);
    }
  }

  RailAdjustment run() {
    RailAdjustment result;
    const ResidualStats before = residual_stats(lengths_of_kept());
    result.before = before;
    drop_impossible_tracks();
    // A start that is far off would look like outliers to the final loss.
    solve(std::max(options_.loss_px, 2 * before.median));
    reject();
    solve(options_.loss_px);
    reject();
    solve(options_.loss_px);
    reject();
    check_views();

    result.rail = rail();
    result.after = residual_stats(lengths_of_kept());
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      result.num_sightings += long(tracks_[i].size());
      const long kept = is_held_[i] ? std::count(keep_[i].begin(), keep_[i].end(), true) : 0;
      result.rejected_sightings += long(tracks_[i].size()) - kept;
      const Eigen::Vector3d& point = unknowns_.points[i];
      result.points.push_back(is_held_[i] ? std::optional(RailPoint{point.head<2>(), point.z()})
                                          : std::nullopt);
    }
    return result;
  }

 private:
  Rail rail() const {
    Rail rail = start_;
    rail.direction = start_.rotation.transpose() * unknowns_.travel;
    rail.positions = unknowns_.positions;
    for (std::size_t i = 0; i < rail.turns.size(); ++i) {
      const double angle = unknowns_.turns[i].norm();
      rail.turns[i] = angle > 0
                          ? Eigen::AngleAxisd(angle, unknowns_.turns[i] / angle).toRotationMatrix()
                          : Eigen::Matrix3d::Identity();
    }
    rail.lens.focal = unknowns_.pinhole[0];
    rail.lens.centre = {unknowns_.pinhole[1], unknowns_.pinhole[2]};
    rail.lens.k1 = unknowns_.distortion[0];
    rail.lens.k2 = unknowns_.distortion[1];
    return rail;
  }

  /// Length of the residual, px; infinite behind the camera.
  double length(std::size_t track_idx, const Sighting& sighting) const {
    const Reprojection reprojection{sighting.pixel};
    Eigen::Vector2d residual;
    const bool before =
        reprojection(unknowns_.travel.data(), &unknowns_.positions[sighting.view_idx],
                     unknowns_.beside[sighting.view_idx].data(),
                     unknowns_.turns[sighting.view_idx].data(), unknowns_.points[track_idx].data(),
                     unknowns_.pinhole.data(), unknowns_.distortion.data(), residual.data());
    return before && residual.allFinite() ? residual.norm()
                                          : std::numeric_limits<double>::infinity();
  }

  template <class Use>
  void for_each_kept(Use use) {
    for (std::size_t i = 0; i < tracks_.size(); ++i)
      for (std::size_t j = 0; is_held_[i] && j < tracks_[i].size(); ++j)
        if (keep_[i][j]) use(i, j);
  }

  std::vector<double> lengths_of_kept() {
    std::vector<double> lengths;
    for_each_kept([&](std::size_t i, std::size_t j) {
      const double px = length(i, tracks_[i][j]);
      if (std::isfinite(px)) lengths.push_back(px);
    });
    return lengths;
  }

  /// The solver can't begin with a point behind a camera.
  void drop_impossible_tracks() {
    for (std::size_t i = 0; i < tracks_.size(); ++i)
      is_held_[i] =
          std::all_of(tracks_[i].begin(), tracks_[i].end(),
                      [&](const Sighting& sighting) { return std::isfinite(length(i, sighting)); });
  }

  void reject() {
    // The length of a Gaussian residual in two axes exceeds four of its medians once in 60 000.
    constexpr double kMedians = 4, kLeastPx = 0.05;
    const double limit = std::max(kLeastPx, kMedians * residual_stats(lengths_of_kept()).median);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (!is_held_[i]) continue;
      for (std::size_t j = 0; j < tracks_[i].size(); ++j)
        keep_[i][j] = length(i, tracks_[i][j]) <= limit;
      // Two sightings left of many agree by chance.
      const long kept = std::count(keep_[i].begin(), keep_[i].end(), true);
      is_held_[i] = kept >= 2 && 2 * kept > long(tracks_[i].size());
    }
  }

  void check_views() {
    std::vector<int> sightings(unknowns_.positions.size(), 0);
    for_each_kept([&](std::size_t i, std::size_t j) { ++sightings[tracks_[i][j].view_idx]; });
    for (std::size_t view = 0; view < sightings.size(); ++view)
      if (sightings[view] < kLeastSightings)
        throw Error(ErrorCode::kBadInput, "view " + std::to_string(view) +
                                              " shares too few features with the others (" +
                                              std::to_string(sightings[view]) + " fit a rail)");
  }

  void add_blocks(ceres::Problem& problem) {
    problem.AddParameterBlock(unknowns_.travel.data(), 3, new ceres::SphereManifold<3>);
    for (double& position : unknowns_.positions) problem.AddParameterBlock(&position, 1);
    const auto [first, last] =
        std::minmax_element(unknowns_.positions.begin(), unknowns_.positions.end());
    problem.SetParameterBlockConstant(&*first);
    problem.SetParameterBlockConstant(&*last);

    const double step = (*last - *first) / double(unknowns_.positions.size() - 1);
    for (Eigen::Vector3d& beside : unknowns_.beside) {
      problem.AddParameterBlock(beside.data(), 3);
      if (options_.off_line_sigma > 0)
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Steadiness, 3, 3>(
                                     new Steadiness{1 / (options_.off_line_sigma * step)}),
                                 nullptr, beside.data());
      else
        problem.SetParameterBlockConstant(beside.data());
    }

    const double sigma = options_.rotation_sigma_deg * std::numbers::pi / 180;
    for (Eigen::Vector3d& turn : unknowns_.turns) {
      problem.AddParameterBlock(turn.data(), 3);
      if (options_.own_rotations)
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<Steadiness, 3, 3>(new Steadiness{1 / sigma}), nullptr,
            turn.data());
      else
        problem.SetParameterBlockConstant(turn.data());
    }

    if (options_.own_rotations && options_.hold_turn_trend) {
      std::vector<double*> turns;
      for (Eigen::Vector3d& turn : unknowns_.turns) turns.push_back(turn.data());
      problem.AddResidualBlock(new TurnTrend(start_.positions, start_turns_), nullptr, turns);
    }

    std::vector<int> fixed;
    if (!options_.refine_focal) fixed.push_back(0);
    if (!options_.refine_centre) fixed.insert(fixed.end(), {1, 2});
    problem.AddParameterBlock(unknowns_.pinhole.data(), 3);
    if (fixed.size() == 3)
      problem.SetParameterBlockConstant(unknowns_.pinhole.data());
    else if (!fixed.empty())
      problem.SetManifold(unknowns_.pinhole.data(), new ceres::SubsetManifold(3, fixed));
    problem.AddParameterBlock(unknowns_.distortion.data(), 2);
    if (!options_.refine_distortion) problem.SetParameterBlockConstant(unknowns_.distortion.data());
  }

  void solve(double loss_px) {
    control_.throw_if_cancelled();
    check_views();
    ceres::Problem problem;
    add_blocks(problem);
    auto* ordering = new ceres::ParameterBlockOrdering;  // the solver's options own it
    // One for all would be freed by the problem just as well, which keeps count.
    auto* loss = new ceres::CauchyLoss(loss_px);
    for_each_kept([&](std::size_t i, std::size_t j) {
      const Sighting& sighting = tracks_[i][j];
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Reprojection, 2, 3, 1, 3, 3, 3, 3, 2>(
              new Reprojection{sighting.pixel}),
          loss, unknowns_.travel.data(), &unknowns_.positions[sighting.view_idx],
          unknowns_.beside[sighting.view_idx].data(), unknowns_.turns[sighting.view_idx].data(),
          unknowns_.points[i].data(), unknowns_.pinhole.data(), unknowns_.distortion.data());
      ordering->AddElementToGroup(unknowns_.points[i].data(), 0);
    });
    ordering->AddElementToGroup(unknowns_.travel.data(), 1);
    for (double& position : unknowns_.positions) ordering->AddElementToGroup(&position, 1);
    for (Eigen::Vector3d& beside : unknowns_.beside) ordering->AddElementToGroup(beside.data(), 1);
    for (Eigen::Vector3d& turn : unknowns_.turns) ordering->AddElementToGroup(turn.data(), 1);
    ordering->AddElementToGroup(unknowns_.pinhole.data(), 1);
    ordering->AddElementToGroup(unknowns_.distortion.data(), 1);

    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.linear_solver_ordering.reset(ordering);
    solver.max_num_iterations = options_.max_iterations;
    solver.num_threads = options_.num_threads > 0 ? options_.num_threads : gigaray::num_threads();
    solver.logging_type = ceres::SILENT;
    StopWhenCancelled stop(control_);
    solver.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    control_.throw_if_cancelled();
    if (!summary.IsSolutionUsable())
      throw Error(ErrorCode::kBadInput,
                  "the cameras can't be brought onto one line; are these photographs of a still "
                  "scene, taken along a rail?");
  }

  const Rail& start_;
  const std::vector<Track>& tracks_;
  const RailAdjustmentOptions& options_;
  const RunControl& control_;
  Unknowns unknowns_;
  std::vector<Eigen::Vector3d> start_turns_;
  std::vector<std::vector<bool>> keep_;  ///< sightings of the tracks
  std::vector<bool> is_held_;            ///< tracks
};

void check_start(const Rail& start, const std::vector<Track>& tracks) {
  const auto bad = [](const std::string& what) { return Error(ErrorCode::kBadInput, what); };
  if (start.num_views() < 3)
    throw bad("a rail needs 3 views or more, there are " + std::to_string(start.num_views()));
  require_argument(start.turns.size() == start.positions.size(),
                   "start.turns: one for each position is needed");
  const auto [first, last] = std::minmax_element(start.positions.begin(), start.positions.end());
  if (!std::isfinite(*first) || !std::isfinite(*last) || !(*last > *first) ||
      !start.direction.allFinite() || !start.rotation.allFinite())
    throw bad("the positions of the cameras on the rail are not finite or all the same");
  if (!(start.lens.focal > 0) || !std::isfinite(start.lens.focal))
    throw bad("the focal length is not a positive number");
  for (const Track& track : tracks) {
    require_argument(track.size() >= 2, "tracks: each needs two sightings or more");
    for (const Sighting& sighting : track) {
      require_argument(sighting.view_idx >= 0 && sighting.view_idx < start.num_views(),
                       "tracks: a sighting is of a view that is not there");
      if (!sighting.pixel.allFinite()) throw bad("a feature's place is not a finite number");
    }
  }
}

}  // namespace

RailAdjustment adjust_rail(const Rail& start, const std::vector<Track>& tracks,
                           const RailAdjustmentOptions& options, const RunControl& control) {
  check_start(start, tracks);
  return Adjuster(start, tracks, options, control).run();
}

}  // namespace gigaray
