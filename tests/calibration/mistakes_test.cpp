// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <cmath>

#include "gigaray/calibration/known_order_start.h"
#include "gigaray/calibration/rail_adjustment.h"
#include "gigaray/calibration/rail_line.h"
#include "gigaray/calibration/rectifying_rotation.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

Rail rail_of(int views) {
  Rail rail;
  for (int i = 0; i < views; ++i) rail.positions.push_back(i);
  rail.turns.assign(std::size_t(views), Eigen::Matrix3d::Identity());
  rail.lens.focal = 100;
  return rail;
}

TEST(MistakesOfCalibration, ARailThatIsNone) {
  const RunControl control;
  const std::vector<Track> none, empty{{}}, elsewhere{{{0, {1, 1}}, {7, {2, 1}}}};
  expect_mistake("no views", [&] { adjust_rail(Rail(), none, {}, control); });
  expect_mistake("empty track", [&] { adjust_rail(rail_of(3), empty, {}, control); });
  expect_mistake("view", [&] { adjust_rail(rail_of(3), elsewhere, {}, control); });
  Rail half = rail_of(3);
  half.turns.pop_back();
  expect_mistake("turns", [&] { adjust_rail(half, none, {}, control); });
  expect_mistake("project", [&] { project(half, 2, RailPoint()); });
  Rail blind = rail_of(3);
  blind.lens.focal = NAN;
  expect_mistake("focal", [&] { adjust_rail(blind, none, {}, control); });
  expect_mistake("view", [] { project(rail_of(3), -1, RailPoint()); });
  expect_mistake("view", [] { project(rail_of(3), 3, RailPoint()); });
  expect_mistake("view", [&] { triangulate(rail_of(3), elsewhere.front()); });
}

TEST(MistakesOfCalibration, PlacesAndTracksThatTellNothing) {
  expect_mistake("no centres", [] { fit_rail_line({}); });
  expect_mistake("one place", [] { fit_rail_line(std::vector<Eigen::Vector3d>(4, {1, 1, 1})); });
  expect_mistake("NaN", [] { fit_rail_line({{0, 0, 0}, {1, 0, 0}, {NAN, 0, 0}}); });
  RadialLens lens;
  expect_mistake("focal", [&] { known_order_start(5, lens, {}); });
  lens.focal = 100;
  expect_mistake("views", [&] { known_order_start(0, lens, {}); });
  expect_mistake("tracks", [&] { known_order_start(5, lens, {}); });
  expect_mistake("empty track", [&] { known_order_start(5, lens, {{}}); });
}

TEST(MistakesOfCalibration, DirectionsAndRectanglesThatAreNone) {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  expect_mistake("zero", [&] { rectifying_rotation(one, {0, 0, 0}); });
  expect_mistake("NaN", [&] { rectifying_rotation(one, {NAN, 0, 0}); });
  expect_mistake("along", [&] { rectifying_rotation(one, {0, 0, 1}); });
  const auto yes = [](int, int) { return true; };
  expect_mistake("step", [&] { largest_valid_rectangle({0, 0, 9, 9}, 0, yes); });
  expect_mistake("empty", [] { largest_valid_rectangle({0, 0, 9, 9}, 2, {}); });
  expect_mistake("view", [] { rectified_tracks(rail_of(2), Camera(), {{{2, {0, 0}}}}); });
}

}  // namespace
}  // namespace gigaray
