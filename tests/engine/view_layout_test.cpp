// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/view_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

/// Views numbered as the layout has it, and what they are taken for: a line.
LightField numbered(const ViewLayout& layout, bool down_first = false) {
  std::vector<View> views;
  for (int row = 0; row < layout.rows; ++row)
    for (int along = 0; along < layout.columns; ++along) {
      const bool goes_back = layout.alternating && row % 2 == 1;
      const int column = goes_back ? layout.columns - 1 - along : along;
      View view{"v" + std::to_string(views.size()), column - (layout.columns - 1) / 2.0,
                row - (layout.rows - 1) / 2.0};
      if (down_first) std::swap(view.s, view.t);
      views.push_back(view);
    }
  Layer front{1.7, 7};
  front.left = 32;
  front.right = 80;
  LightField light_field = analytic_field(161, 95, views, {{-0.6, 3}, front}).light_field;
  for (std::size_t i = 0; i < views.size(); ++i)
    light_field.views[i] = {views[i].name, double(i), 0};
  light_field.kind = kind_from_positions(light_field.views);
  return light_field;
}

std::vector<LayoutTrial> trials_of(const LightField& light_field) {
  std::vector<int> cells(light_field.views.size());
  std::iota(cells.begin(), cells.end(), 0);
  return try_layouts(light_field, cells, int(cells.size()), {});
}

TEST(ViewLayout, AGridInTheOrderOfOneNumberIsFound) {
  for (const ViewLayout layout : {ViewLayout{7, 7}, {5, 7}, {7, 5}, {4, 6, true}, {3, 4}})
    for (const bool down_first : {false, true}) {
      const auto trials = trials_of(numbered(layout, down_first));
      ASSERT_FALSE(trials.empty());
      EXPECT_EQ(trials.front().layout.rows, layout.rows);
      EXPECT_EQ(trials.front().layout.columns, layout.columns);
      EXPECT_EQ(trials.front().layout.alternating, layout.alternating);
      EXPECT_GT(trials.front().agreement, trials.front().as_line + 2 * kGridLead);
    }
}

TEST(ViewLayout, ALineStaysOne) {
  for (const int count : {12, 16, 25, 36})
    for (const LayoutTrial& trial : trials_of(numbered({1, count})))
      EXPECT_LT(trial.agreement, trial.as_line) << trial.layout.rows << "x" << trial.layout.columns;
}

TEST(ViewLayout, NumbersThatFillNoGridAreNotTried) {
  EXPECT_TRUE(trials_of(numbered({1, 7})).empty());
  EXPECT_TRUE(trials_of(numbered({1, 34})).empty());  // 2 × 17: too many for two rows
}

TEST(ViewLayout, PlacesMayBeEmptyInTheNumbering) {
  LightField light_field = numbered({5, 5});
  std::vector<int> cells(25), gone{3, 12, 17};
  std::iota(cells.begin(), cells.end(), 0);
  light_field = without(light_field, gone);
  std::erase_if(cells, [&](int cell) { return std::ranges::count(gone, cell) > 0; });
  const auto trials = try_layouts(light_field, cells, 25, {});
  EXPECT_EQ(trials.front().layout, (ViewLayout{5, 5}));
  EXPECT_GT(trials.front().agreement, trials.front().as_line + kGridLead);
  EXPECT_NEAR(try_layout(light_field, cells, {5, 5}, {}).agreement, trials.front().agreement, 1e-9);
}

}  // namespace
}  // namespace gigaray::testing_support
