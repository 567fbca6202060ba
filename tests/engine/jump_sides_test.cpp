// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Which side of a jump a pixel belongs to.
#include "reference/jump_sides.h"

#include <gtest/gtest.h>

#include "engine/host_steps.h"
#include "gigaray/samplers/any_sampler.h"
#include "src/make_workspace.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

using reference::Sides;
using reference::sides_at;

constexpr float kNaN = kNoEstimate;

StripMap<float> map_of(const std::vector<std::vector<float>>& rows) {
  StripMap<float> map(int(rows[0].size()), {0, int(rows.size())});
  for (std::size_t v = 0; v < rows.size(); ++v)
    std::copy(rows[v].begin(), rows[v].end(), map.row(int(v)));
  return map;
}

TEST(SidesOfJumps, AreTheNearestEstimatesAboveAndBelowTheMiddle) {
  const auto map = map_of({{0, 0, 0, 2.0f, 2.2f}, {0, 0.1f, 0, 2.1f, 2.2f}, {0, 0, kNaN, 2, 2}});
  const Sides sides = sides_at(map, 3, 2, 1, 0.5f);
  EXPECT_FLOAT_EQ(sides.middle, 1.1f);
  EXPECT_EQ(sides.near, 2.1f);
  EXPECT_EQ(sides.near_u, 3);
  EXPECT_EQ(sides.far, 0);
  EXPECT_EQ(sides.far_u, 2) << "the pixel itself is on the far side";
  EXPECT_TRUE(std::isnan(sides_at(map, 3, 2, 1, 2.3f).near)) << "no jump of that size";
  EXPECT_TRUE(std::isnan(sides_at(map, 3, 0, 1, 0.5f).near)) << "too far from it";
}

/// A card before a wall, seen by a grid of views; the middle one is the reference.
struct Card {
  AnalyticField field;
  std::unique_ptr<HostSteps> steps;
  std::vector<View> views = grid_of_views(5, 5);
  static constexpr int kWidth = 81, kHeight = 61, kRef = 12;
  static constexpr float kJump = 0.25f;

  Card() {
    Layer front{1.2, 2};
    front.left = 25.5;
    front.right = 52.5;
    front.top = 18.5;
    front.bottom = 40.5;
    field = analytic_field(kWidth, kHeight, views, {{-0.4, 1}, front});
    DepthOptions options = auto_options();
    options.disparity = DisparityRange{-1, 2};
    options.hypotheses = 61;
    const HypothesisRange hypotheses{-1, 2, 61};
    steps = std::make_unique<HostSteps>(make_reference_workspace(
        GridSampler(views), WorkspaceSetup{options, hypotheses, LightFieldKind::k4D, 8}));
    std::vector<std::uint8_t> pixels;
    std::vector<Image<std::uint16_t>> pictures;
    for (int view = 0; view < int(views.size()); ++view)
      pictures.push_back(read_view(field.light_field, view));
    for (int v = 0; v < kHeight; ++v)
      for (const auto& picture : pictures)
        pixels.insert(pixels.end(), picture.row(v), picture.row(v) + 3 * kWidth);
    steps->begin_level({0, kWidth, kHeight});
    steps->load_band({0, kHeight}, all_views(int(views.size())), pixels, BandEncoding::kBits8);
  }

  bool is_card(int u, int v) const { return u >= 26 && u <= 52 && v >= 19 && v <= 40; }
  /// The card with an edge that is moved outwards by some pixels.
  StripMap<float> estimates(int fatter) const {
    StripMap<float> map(kWidth, {0, kHeight});
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const bool card =
            u >= 26 - fatter && u <= 52 + fatter && v >= 19 - fatter && v <= 40 + fatter;
        map.row(v)[u] = card ? 1.2f : -0.4f;
      }
    return map;
  }
  int wrong(const StripMap<float>& map) const {
    int wrong = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) wrong += map.row(v)[u] != (is_card(u, v) ? 1.2f : -0.4f);
    return wrong;
  }
  StripMap<float> choose(const StripMap<float>& disparity, StripMap<float>& confidence) const {
    const RowRange all{0, kHeight};
    StripMap<std::uint8_t> todo(kWidth, all);
    for (int v = 0; v < kHeight; ++v) std::fill_n(todo.row(v), kWidth, 1);
    StripMap<float> evidence(kWidth, all), chosen = evidence, sure = evidence;
    steps->side_evidence(kRef, all, kJump, todo, disparity, evidence);
    steps->choose_sides(kRef, all, kJump, disparity, confidence, evidence, chosen, sure);
    confidence = sure;
    return chosen;
  }
};

TEST(SidesOfJumps, AnEdgeThatIsAPixelOffGoesBackToItsPlace) {
  const Card card;
  for (const int fatter : {-1, 1}) {
    StripMap<float> map = card.estimates(fatter), confidence(Card::kWidth, {0, Card::kHeight});
    const int before = card.wrong(map);
    map = card.choose(map, confidence);
    map = card.choose(map, confidence);
    EXPECT_LT(card.wrong(map), before / 5) << before << " were wrong, fatter by " << fatter;
  }
}

TEST(SidesOfJumps, ARightEdgeStaysAndWhatGoesOverTakesItsConfidenceAlong) {
  const Card card;
  StripMap<float> confidence(Card::kWidth, {0, Card::kHeight});
  EXPECT_LE(card.wrong(card.choose(card.estimates(0), confidence)), 4);
  const StripMap<float> fat = card.estimates(1);
  for (int v = 0; v < Card::kHeight; ++v)
    for (int u = 0; u < Card::kWidth; ++u) confidence.row(v)[u] = fat.row(v)[u] > 0 ? 0.25f : 0.75f;
  const StripMap<float> chosen = card.choose(fat, confidence);
  for (int v = 0; v < Card::kHeight; ++v)
    for (int u = 0; u < Card::kWidth; ++u)
      EXPECT_EQ(confidence.row(v)[u], chosen.row(v)[u] > 0 ? 0.25f : 0.75f) << u << ", " << v;
}

TEST(SidesOfJumps, WhatIsNotToDoOrHasNoJumpSaysNothing) {
  const Card card;
  const RowRange all{0, Card::kHeight};
  StripMap<std::uint8_t> todo(Card::kWidth, all);
  for (int v = 0; v < Card::kHeight; ++v) std::fill_n(todo.row(v), 40, 1);
  StripMap<float> evidence(Card::kWidth, all);
  card.steps->side_evidence(Card::kRef, all, Card::kJump, todo, card.estimates(0), evidence);
  EXPECT_FALSE(std::isnan(evidence.row(30)[25]));
  EXPECT_FALSE(std::isnan(evidence.row(30)[26]));
  EXPECT_TRUE(std::isnan(evidence.row(30)[52])) << "not to do";
  EXPECT_TRUE(std::isnan(evidence.row(30)[35])) << "in the middle of the card";
  EXPECT_GT(evidence.row(30)[26], 0.1f);
  EXPECT_LT(evidence.row(30)[25], -0.1f);
}

}  // namespace
}  // namespace gigaray::testing_support
