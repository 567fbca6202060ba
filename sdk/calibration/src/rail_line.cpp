// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rail_line.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "gigaray/core/error.h"

namespace gigaray {

RailLine fit_rail_line(const std::vector<Eigen::Vector3d>& centres) {
  if (centres.size() < 3)
    throw Error(ErrorCode::kBadInput,
                "a rail needs 3 cameras or more, there are " + std::to_string(centres.size()));
  RailLine line;
  line.origin.setZero();
  for (const Eigen::Vector3d& centre : centres) {
    if (!centre.allFinite())
      throw Error(ErrorCode::kBadInput, "the place of a camera is not a finite number");
    line.origin += centre / double(centres.size());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& centre : centres)
    scatter += (centre - line.origin) * (centre - line.origin).transpose();
  // Eigenvalues rise: the last one belongs to the direction of the largest spread.
  line.direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2);
  if (line.direction.dot(centres.back() - centres.front()) < 0) line.direction *= -1;

  double sum_of_squares = 0;
  for (const Eigen::Vector3d& centre : centres) {
    const Eigen::Vector3d offset = centre - line.origin;
    line.positions.push_back(line.direction.dot(offset));
    line.distances.push_back((offset - line.positions.back() * line.direction).norm());
    sum_of_squares += line.distances.back() * line.distances.back();
    line.max_distance = std::max(line.max_distance, line.distances.back());
  }
  line.rms_distance = std::sqrt(sum_of_squares / double(centres.size()));
  std::vector<double> steps = steps_between(line.positions);
  std::nth_element(steps.begin(), steps.begin() + long(steps.size() / 2), steps.end());
  line.median_step = steps[steps.size() / 2];
  if (!(line.median_step > 0))
    throw Error(ErrorCode::kBadInput, "the cameras stand at one place; a rail needs them to move");
  return line;
}

std::vector<double> steps_between(std::vector<double> positions) {
  std::sort(positions.begin(), positions.end());
  std::vector<double> steps;
  for (std::size_t i = 1; i < positions.size(); ++i)
    steps.push_back(positions[i] - positions[i - 1]);
  return steps;
}

}  // namespace gigaray
