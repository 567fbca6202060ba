// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What the other of two views can't confirm, and what two views of a wide range ask for.
#include "reference/hidden.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/planned_run.h"
#include "gigaray/samplers/any_sampler.h"
#include "src/few_views.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

constexpr int kWidth = 40, kHeight = 12;
constexpr float kCard = 6, kWall = 1;
constexpr HypothesisRange kRange{0, 8, 81};

/// A card, columns 20 … 29, before a wall; the other view stands to the right, so that the wall is
/// hidden in columns 15 … 19 and the first column of the wall leaves it.
struct Pair {
  StripMap<float> disparity{kWidth, {0, kHeight}}, confidence = disparity;
  StripMap<std::uint8_t> todo{kWidth, {0, kHeight}}, hidden = todo, guessed = todo;
  EpiSampler sampler{row_of_views(2)};
  Pair() {
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const bool card = u >= 20 && u < 30, behind = u >= 15 && u < 20;
        disparity.row(v)[u] = card ? kCard : behind ? 4 : kWall;
        confidence.row(v)[u] = behind ? 0.1f : 0.8f;
        todo.row(v)[u] = 1;
      }
  }
  bool is_hidden(int u, int v) const {
    return reference::is_hidden(sampler, 0, u, v, kHeight, kRange, 1,
                                MapView<const float>(disparity), MapView<const float>(confidence));
  }
};

TEST(WhatIsHidden, LosesItsPlaceToWhatIsMoreConfident) {
  const Pair pair;
  // From the wrong 4 px the other view's place is one that the card or the wall has, too.
  for (int u = 16; u < 20; ++u) EXPECT_TRUE(pair.is_hidden(u, 5)) << u;
  for (int u = 1; u < 11; ++u) EXPECT_FALSE(pair.is_hidden(u, 5)) << u;
  for (int u = 20; u < 40; ++u) EXPECT_FALSE(pair.is_hidden(u, 5)) << u;
  EXPECT_TRUE(pair.is_hidden(0, 5)) << "outside the other picture";
}

TEST(WhatIsHidden, ContinuesWhatIsBehind) {
  Pair pair;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) pair.hidden.row(v)[u] = pair.is_hidden(u, v);
  const RowRange all{0, kHeight};
  reference::find_specks(all, kHeight, 1, pair.todo, pair.disparity, pair.hidden, pair.guessed);
  reference::fill_hidden(all, 1, pair.guessed, pair.disparity, pair.confidence);
  for (int u = 0; u < kWidth; ++u) {
    EXPECT_EQ(pair.disparity.row(5)[u], u >= 20 && u < 30 ? kCard : kWall) << u;
    EXPECT_GT(pair.confidence.row(5)[u], 0) << u;
  }
  EXPECT_FLOAT_EQ(pair.confidence.row(5)[17], FILLED_CONFIDENCE * 0.8f);
}

TEST(WhatIsHidden, ASpeckIsAGuessAndAThinThingIsNot) {
  Pair pair;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) pair.disparity.row(v)[u] = u >= 8 && u < 12 ? kCard : kWall;
  for (int v = 4; v < 7; ++v)
    for (int u = 30; u < 33; ++u) pair.disparity.row(v)[u] = kCard;
  reference::find_specks({0, kHeight}, kHeight, 1, pair.todo, pair.disparity, pair.hidden,
                         pair.guessed);
  EXPECT_TRUE(pair.guessed.row(5)[31]);
  EXPECT_FALSE(pair.guessed.row(5)[9]);
  EXPECT_FALSE(pair.guessed.row(5)[25]);
}

TEST(FewViews, JumpsCostMoreTheFewerThereAre) {
  const DepthOptions usual = auto_options();
  float before = std::numeric_limits<float>::infinity();
  for (const int views : {2, 3, 4, 5, 9}) {
    DepthOptions options = usual;
    LightField field = card_before_wall(row_of_views(views), 32, 24).light_field;
    adapt_to_few_views(field, options);
    EXPECT_EQ(options.support.fill_hidden, views == 2) << views;
    EXPECT_LE(options.support.jump_price, before) << views;
    before = options.support.jump_price;
    if (views > 1 + kMostFewViews) {
      EXPECT_EQ(options.support.jump_price, usual.support.jump_price);
      EXPECT_EQ(options.support.jump_sigma_colour, usual.support.jump_sigma_colour);
    }
  }
}

}  // namespace
}  // namespace gigaray::testing_support
