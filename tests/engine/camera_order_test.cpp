// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/camera_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "gigaray/engine/reconstruct.h"
#include "support/analytic_field.h"
#include "support/errors.h"

namespace gigaray::testing_support {
namespace {

AnalyticField two_planes(const std::vector<View>& views, double far, double near) {
  Layer front{near, 7};
  front.left = 32;
  front.right = 80;
  return analytic_field(161, 95, views, {{far, 3}, front});
}

struct Messages {
  RunControl control;
  std::string all;
  Messages() {
    control.on_message = [this](const std::string& message) { all += message + "\n"; };
  }
};

TEST(CheckDirection, ARowThatMovesTheOtherWayIsTurnedAround) {
  LightField light_field = two_planes(row_of_views(7), 0.4, 1.7).light_field;
  const std::vector<View> right = light_field.views;
  for (View& view : light_field.views) view.s = -view.s;  // the wrong assumption
  light_field.sign_is_assumed = true;
  Messages messages;
  const auto range = check_direction(light_field, messages.control);
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_EQ(light_field.views[i].s, right[i].s);
  EXPECT_NE(messages.all.find("direction left, other"), std::string::npos) << messages.all;
  EXPECT_FALSE(light_field.sign_is_assumed);
  ASSERT_TRUE(range);
  EXPECT_LE(range->min, 0.4);
  EXPECT_GE(range->max, 1.7);
  EXPECT_GT(range->min, -0.5);
}

TEST(CheckDirection, ARightAssumptionStaysSilently) {
  LightField light_field = two_planes(row_of_views(7), 0.4, 1.7).light_field;
  const std::vector<View> before = light_field.views;
  light_field.sign_is_assumed = true;
  Messages messages;
  EXPECT_TRUE(check_direction(light_field, messages.control));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(light_field.views[i].s, before[i].s);
  EXPECT_EQ(messages.all, "");
}

TEST(DoubtPositions, StatedOnesThatAgreeBetterTurnedAreTold) {
  LightField light_field = two_planes(grid_of_views(5, 3), 0.4, 1.7).light_field;
  Messages right;
  doubt_positions(light_field, right.control);
  EXPECT_EQ(right.all, "");
  LightField upwards = light_field, exchanged = light_field;
  for (View& view : upwards.views) view.t *= -1;
  for (View& view : exchanged.views) std::swap(view.s, view.t);
  Messages of_upwards, of_exchanged;
  doubt_positions(upwards, of_upwards.control);
  EXPECT_NE(of_upwards.all.find("with the sign of down changed"), std::string::npos)
      << of_upwards.all;
  doubt_positions(exchanged, of_exchanged.control);
  EXPECT_NE(of_exchanged.all.find("with right and down exchanged"), std::string::npos)
      << of_exchanged.all;
  EXPECT_EQ(upwards.views[0].t, -light_field.views[0].t);
}

TEST(CheckDirection, AKnownSignIsNotTouchedAndNothingIsRead) {
  LightField light_field = two_planes(row_of_views(7), -1.7, -0.4).light_field;
  const std::vector<View> before = light_field.views;
  light_field.pixels = nullptr;
  Messages messages;
  EXPECT_FALSE(check_direction(light_field, messages.control));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(light_field.views[i].s, before[i].s);
}

/// All eight ways to number the views of a grid, as `--direction` says them, and what they do to
/// the true position.
struct Numbering {
  const char* ways;
  int s_from_s, s_from_t, t_from_s, t_from_t;  // what the reader took for s and t
};
constexpr Numbering kNumberings[] = {{"right,down", 1, 0, 0, 1}, {"left,down", -1, 0, 0, 1},
                                     {"right,up", 1, 0, 0, -1},  {"left,up", -1, 0, 0, -1},
                                     {"down,right", 0, 1, 1, 0}, {"down,left", 0, 1, -1, 0},
                                     {"up,right", 0, -1, 1, 0},  {"up,left", 0, -1, -1, 0}};

void expect_found(const LightField& truth, const Numbering& numbering) {
  LightField light_field = truth;
  for (View& view : light_field.views) {
    const double s = view.s, t = view.t;
    view.s = numbering.s_from_s * s + numbering.s_from_t * t;
    view.t = numbering.t_from_s * s + numbering.t_from_t * t;
  }
  light_field.sign_is_assumed = true;
  light_field.kind = kind_from_positions(light_field.views);
  Messages messages;
  const auto range = check_direction(light_field, messages.control);
  for (std::size_t i = 0; i < truth.views.size(); ++i) {
    EXPECT_EQ(light_field.views[i].s, truth.views[i].s) << numbering.ways;
    EXPECT_EQ(light_field.views[i].t, truth.views[i].t) << numbering.ways;
  }
  EXPECT_EQ(light_field.kind, truth.kind);
  EXPECT_NE(messages.all.find(numbering.ways), std::string::npos) << messages.all;
  EXPECT_EQ(std::count(messages.all.begin(), messages.all.end(), '\n'), 1) << messages.all;
  ASSERT_TRUE(range);
  EXPECT_GT(range->max, 1);
  EXPECT_GT(range->min, -0.5);
}

TEST(CheckDirection, AGridIsFoundInAllEightOrders) {
  const LightField truth = two_planes(grid_of_views(3, 3), 0.5, 1.6).light_field;
  for (const Numbering& numbering : kNumberings) expect_found(truth, numbering);
}

TEST(CheckDirection, AnIrregularIncompleteGridIsFoundInAllEightOrders) {
  const LightField truth = two_planes(irregular_grid(), 0.5, 1.6).light_field;
  for (const Numbering& numbering : kNumberings) expect_found(truth, numbering);
}

TEST(CheckDirection, ASeriesThatGoesDownIsNoRow) {
  const LightField truth = two_planes(grid_of_views(1, 7), 0.5, 1.6).light_field;
  for (const int sign : {1, -1}) {
    LightField light_field = truth;
    for (View& view : light_field.views) {
      view.s = sign * view.t;
      view.t = 0;
    }
    light_field.kind = LightFieldKind::k3D;
    light_field.sign_is_assumed = true;
    Messages messages;
    check_direction(light_field, messages.control);
    EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
    for (std::size_t i = 0; i < truth.views.size(); ++i)
      EXPECT_EQ(light_field.views[i].t, truth.views[i].t);
    EXPECT_NE(messages.all.find(sign > 0 ? "direction down," : "direction up,"), std::string::npos)
        << messages.all;
  }
}

TEST(CheckDirection, PicturesThatDoNotMatchAreRefusedByName) {
  LightField light_field = analytic_field(93, 61, grid_of_views(3, 3), {{0.5, 1, 0}}).light_field;
  light_field.sign_is_assumed = true;
  Messages messages;
  expect_error(ErrorCode::kBadInput, {"DepthOptions::disparity"},
               [&] { check_direction(light_field, messages.control); });
}

/// A background and two objects, one on either side of the plane of focus.
AnalyticField focused(const std::vector<View>& views, double left_disparity) {
  Layer left{left_disparity, 7}, right{1.2, 9};
  left.left = 25;
  left.right = 60;
  left.top = right.top = 20;
  left.bottom = right.bottom = 75;
  right.left = 100;
  right.right = 135;
  return analytic_field(161, 95, views, {right, left, {-1.1, 3}});
}

TEST(CheckDirection, AFocusedRigIsTurnedByWhatHidesWhat) {
  for (const auto& views : {row_of_views(7), grid_of_views(5, 5)})
    for (const int sign : {1, -1}) {
      const LightField truth = focused(views, 0.8).light_field;
      LightField light_field = truth;
      for (View& view : light_field.views) {
        view.s *= sign;
        view.t *= sign;
      }
      light_field.sign_is_assumed = true;
      Messages messages;
      const auto range = check_direction(light_field, messages.control);
      for (std::size_t i = 0; i < truth.views.size(); ++i)
        EXPECT_EQ(light_field.views[i].s, truth.views[i].s) << messages.all;
      EXPECT_EQ(messages.all.find("both signs"), std::string::npos) << messages.all;
      ASSERT_TRUE(range);
      EXPECT_LE(range->min, -1.1);
      EXPECT_GE(range->max, 1.2);
    }
}

TEST(CheckDirection, WhenNothingTellsNearFromFarTheAssumptionStaysAndIsReported) {
  // One above the other before a camera that goes sideways: neither hides the other.
  Layer above{-1.1, 9}, below{1.2, 9};
  below.top = 48;
  LightField light_field = analytic_field(161, 95, row_of_views(7), {above, below}).light_field;
  const std::vector<View> views = light_field.views;
  light_field.sign_is_assumed = true;
  Messages messages;
  check_direction(light_field, messages.control);
  for (std::size_t i = 0; i < views.size(); ++i) EXPECT_EQ(light_field.views[i].s, views[i].s);
  EXPECT_NE(messages.all.find("both signs"), std::string::npos) << messages.all;
}

/// Depth of the middle of a row.
Reconstruction depth_of(const LightField& light_field, std::optional<DisparityRange> range,
                        const RunControl& control) {
  DepthOptions options = auto_options();
  options.disparity = range;
  options.hypotheses = 16;
  options.views = {3};
  return reconstruct(light_field, options, {"reference", ""}, control);
}

TEST(Reconstruct, ADirectionThatIsOnlyAssumedIsCheckedAndTurned) {
  const LightField truth = two_planes(row_of_views(7), 0.4, 1.7).light_field;
  LightField mirrored = truth;
  mirrored.sign_is_assumed = true;
  for (View& view : mirrored.views) view.s = -view.s;
  for (const auto& range :
       std::vector<std::optional<DisparityRange>>{std::nullopt, DisparityRange{0, 2}}) {
    LightField checked = mirrored;
    const auto estimated = check_direction(checked, RunControl());
    Reconstruction expected = depth_of(checked, range ? range : estimated, RunControl());
    Messages messages;
    Reconstruction found = depth_of(mirrored, range, messages.control);
    EXPECT_NE(messages.all.find("direction left, other than assumed"), std::string::npos)
        << messages.all;
    EXPECT_EQ(messages.all.find("disparity range") != std::string::npos, !range) << messages.all;
    EXPECT_EQ(found.options().disparity, expected.options().disparity);
    const FloatMap a = expected.view(3).disparity, b = found.view(3).disparity;
    for (std::size_t i = 0; i < a.size(); ++i)
      ASSERT_TRUE(a.data()[i] == b.data()[i] ||
                  (std::isnan(a.data()[i]) && std::isnan(b.data()[i])));
    EXPECT_GT(a(80, 10), 0) << "nearer is positive";
    for (int i = 0; i < 7; ++i)
      EXPECT_EQ(found.light_field().views[i].s, truth.views[i].s) << "the positions of the maps";
    EXPECT_FALSE(found.light_field().sign_is_assumed);
    EXPECT_EQ(read_view(found.light_field(), 2), read_view(truth, 2));
  }
}

TEST(Reconstruct, ADirectionThatIsAssumedRightlyNeedsNoWord) {
  LightField light_field = two_planes(row_of_views(7), 0.4, 1.7).light_field;
  light_field.sign_is_assumed = true;
  Messages messages;
  depth_of(light_field, DisparityRange{0, 2}, messages.control);
  EXPECT_EQ(messages.all, "");
}

TEST(Reconstruct, ADirectionThatNothingTellsIsRefused) {
  Layer above{-1.1, 9}, below{1.2, 9};
  below.top = 48;
  LightField light_field = analytic_field(161, 95, row_of_views(7), {above, below}).light_field;
  light_field.sign_is_assumed = true;
  expect_error(ErrorCode::kInvalidArgument, {"OpenOptions::direction", "sign_is_assumed"}, [&] {
    depth_of(light_field, DisparityRange{-2, 2}, RunControl());
  });
  DepthOptions options = auto_options();
  options.disparity = DisparityRange{-2, 2};
  expect_error(ErrorCode::kInvalidArgument, {"OpenOptions::direction"}, [&] {
    probe(light_field, options, {"reference", ""}, 3, 40, 40, RunControl());
  });
}

}  // namespace
}  // namespace gigaray::testing_support
