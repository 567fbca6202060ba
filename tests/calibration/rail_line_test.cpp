// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/calibration/rail_line.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

TEST(RailLine, CentresOnALineGiveItExactly) {
  const Eigen::Vector3d origin(1, 2, 3), direction = Eigen::Vector3d(2, -1, 2) / 3;
  const std::vector<double> positions{-3, -1.5, 0, 1, 3.5};
  std::vector<Eigen::Vector3d> centres;
  for (const double x : positions) centres.push_back(origin + x * direction);
  const RailLine line = fit_rail_line(centres);
  EXPECT_LT((line.direction - direction).norm(), 1e-12);
  EXPECT_LT((line.origin - origin).norm(), 1e-12);
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_NEAR(line.positions[i], positions[i], 1e-12);
  EXPECT_NEAR(line.max_distance, 0, 1e-12);
  EXPECT_NEAR(line.median_step, 1.5, 1e-12);
}

TEST(RailLine, DistancesAreOrthogonalToTheLine) {
  // Two pairs beside the x axis, 0.1 up and down: the axis is the best line.
  const RailLine line = fit_rail_line({{0, 0.1, 0}, {1, -0.1, 0}, {2, -0.1, 0}, {3, 0.1, 0}});
  EXPECT_LT((line.direction - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(line.rms_distance, 0.1, 1e-12);
  EXPECT_NEAR(line.max_distance, 0.1, 1e-12);
}

TEST(RailLine, DirectionGoesFromTheFirstToTheLastCentre) {
  EXPECT_LT(fit_rail_line({{3, 0, 0}, {2, 0, 0}, {0, 0, 0}}).direction.x(), 0);
}

TEST(RailLine, StepsAreThoseOfNeighboursAlongTheLineInWhateverOrder) {
  EXPECT_EQ(steps_between({3, 0, 1}), (std::vector<double>{1, 2}));
  EXPECT_NEAR(fit_rail_line({{4, 0, 0}, {0, 0, 0}, {2, 0, 0}}).median_step, 2, 1e-12);
}

TEST(RailLine, TooFewStandingStillOrNotFiniteIsRefused) {
  expect_error(ErrorCode::kBadInput, {"3 cameras"}, [] { fit_rail_line({{0, 0, 0}, {1, 0, 0}}); });
  expect_error(ErrorCode::kBadInput, {"one place"}, [] {
    fit_rail_line({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error(ErrorCode::kBadInput, {"finite"}, [&] {
    fit_rail_line({{0, 0, 0}, {nan, 0, 0}, {2, 0, 0}});
  });
}

}  // namespace
}  // namespace gigaray
