// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "reference/search_bounds.h"

#include "reference/masks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gigaray {
namespace {

constexpr HypothesisRange kRange{-2, 3, 101};
constexpr PackedEstimate kNone = 0;

PackedEstimate at(float hypothesis) { return pack_estimate(hypothesis, 0.5f); }

std::vector<Search> coarsened(int width, const std::vector<PackedEstimate>& estimates,
                              const std::vector<Search>& search = {}) {
  std::vector<Search> coarse((width + 1) / 2);
  coarsen_bounds(estimates, search, width, kRange, coarse);
  return coarse;
}

void expect_search(const Search& search, float low, float high) {
  EXPECT_EQ(search.low, low);
  EXPECT_EQ(search.high, high);
}

TEST(PackedEstimate, NearerThenMoreConfidentIsLarger) {
  const float hypotheses[] = {-3.5f, -1e-3f, -0.0f, 0.0f, 1e-30f, 0.25f, 7.0f};
  for (std::size_t i = 0; i + 1 < std::size(hypotheses); ++i) {
    EXPECT_LT(pack_estimate(hypotheses[i], 9.0f), pack_estimate(hypotheses[i + 1], 0.0f));
    EXPECT_LT(pack_estimate(hypotheses[i], 0.1f), pack_estimate(hypotheses[i], 0.2f));
    EXPECT_GT(pack_estimate(hypotheses[i], 0.0f), kNone);
  }
}

TEST(PackedEstimate, RoundTrip) {
  for (const float h : {-2.75f, -0.0f, 0.0f, 1e-30f, 3.125f}) {
    EXPECT_EQ(hypothesis_of(pack_estimate(h, 0.375f)), h);
    EXPECT_EQ(confidence_of(pack_estimate(h, 0.375f)), 0.375f);
  }
  EXPECT_TRUE(std::isnan(hypothesis_of(kNone)));
  EXPECT_EQ(confidence_of(pack_estimate(1, -0.5f)), 0) << "no confidence is below none";
}

TEST(SearchBounds, NearestEstimatesToLeftAndRightBoundTheSearch) {
  const auto coarse = coarsened(8, {at(9), at(1), kNone, kNone, kNone, kNone, at(0.5f), at(8)});
  ASSERT_EQ(coarse.size(), 4u);
  expect_search(coarse[1], 0.5f, 1);
  expect_search(coarse[2], 0.5f, 1);
  for (const int done : {0, 3}) EXPECT_TRUE(std::isnan(coarse[done].low));
}

TEST(SearchBounds, ASideWithoutEstimateLeavesTheBoundOpen) {
  const auto coarse = coarsened(6, {kNone, kNone, at(1), at(1), kNone, kNone});
  expect_search(coarse[0], -2, 3);
  expect_search(coarse[2], -2, 3);
  EXPECT_TRUE(std::isnan(coarse[1].low));
  for (const Search& search : coarsened(4, {kNone, kNone, kNone, kNone})) {
    expect_search(search, -2, 3);
    EXPECT_TRUE(std::isnan(search.known_low));
  }
}

TEST(SearchBounds, ACoarsePixelJoinsItsFinerPixels) {
  // Two rows: the upper searches 0.25 … 0.5, the lower 1 … 2.
  const auto coarse = coarsened(4, {at(0.25f), kNone, kNone, at(0.5f),  //
                                    at(1), kNone, kNone, at(2)});
  expect_search(coarse[0], 0.25f, 2);
  EXPECT_EQ(coarse[0].known_low, 0.25f);
  EXPECT_EQ(coarse[0].known_high, 1);
  EXPECT_EQ(coarse[1].known_low, 0.5f);
  EXPECT_EQ(coarse[1].known_high, 2);
}

TEST(SearchBounds, OddWidthAndOneRow) {
  const auto coarse = coarsened(5, {at(1), at(1), kNone, at(1), kNone});
  ASSERT_EQ(coarse.size(), 3u);
  EXPECT_TRUE(std::isnan(coarse[0].low));
  expect_search(coarse[1], 1, 1);
  expect_search(coarse[2], -2, 3);
}

TEST(SearchBounds, WhatAFinerLevelKnewBoundsTheSearchToo) {
  // Level 1: pixel 1 has no estimate of its own but stands for finer pixels at 0.25 … 0.75.
  std::vector<Search> search(4);
  search[1].low = -2;
  search[1].high = 3;
  search[1].known_low = 0.25f;
  search[1].known_high = 0.75f;
  search[2].low = -2;
  search[2].high = 3;
  const auto coarse = coarsened(4, {at(1), kNone, kNone, at(2)}, search);
  // Pixel 1: its neighbours and itself; pixel 2: between the known pixels 1 and 3.
  expect_search(coarse[0], 0.25f, 2);
  expect_search(coarse[1], 0.25f, 2);
  EXPECT_EQ(coarse[0].known_low, 0.25f);
  EXPECT_EQ(coarse[0].known_high, 1);
}

TEST(SearchBounds, APixelWhoseFinerPixelsAllHaveDepthIsNotSearchedAgain) {
  std::vector<Search> search(2);  // low is NaN: nothing to do there
  search[0].known_low = search[1].known_low = 1;
  search[0].known_high = search[1].known_high = 1;
  const auto coarse = coarsened(2, {kNone, kNone}, search);
  EXPECT_TRUE(std::isnan(coarse[0].low));
  EXPECT_EQ(coarse[0].known_low, 1);
}

TEST(SearchBounds, IndicesCoverTheBoundsWithOneMoreOnBothSides) {
  Search search;
  search.low = 0.13f;
  search.high = 0.52f;
  const HypothesisBounds bounds = bounds_of(search, kRange);
  EXPECT_LE(kRange.value(bounds.first + 1), 0.13);
  EXPECT_GT(kRange.value(bounds.first + 2), 0.13);
  EXPECT_GE(kRange.value(bounds.last - 1), 0.52);
  EXPECT_LT(kRange.value(bounds.last - 2), 0.52);
}

TEST(SearchBounds, IndicesStayWithinTheRange) {
  Search search;
  search.low = -50;
  search.high = 50;
  EXPECT_EQ(bounds_of(search, kRange), (HypothesisBounds{0, 100}));
  search.low = search.high = 3;
  EXPECT_EQ(bounds_of(search, kRange).last, 100);
  search.low = search.high = -2;
  EXPECT_EQ(bounds_of(search, kRange).first, 0);
}

struct Holes {
  StripMap<std::uint8_t> todo{60, {0, 40}};
  StripMap<float> estimates{60, {0, 40}};
  StripMap<HypothesisBounds> bounds{60, {0, 40}};

  /// A surface at 1 with a nearer one at 2 from column 30 on.
  Holes() {
    for (int v = 0; v < 40; ++v)
      for (int u = 0; u < 60; ++u) {
        estimates.row(v)[u] = u < 30 ? 1 : 2;
        bounds.row(v)[u] = {0, 100};
      }
  }
  void bound() {
    bound_thin_holes({0, 40}, todo, open_mask(todo, {0, 40}, 40, kThinHole), estimates, kRange,
                     bounds);
  }
  void punch(int u, int width) {
    for (int v = 10; v < 30; ++v)
      for (int x = u; x < u + width; ++x) {
        todo.row(v)[x] = 1;
        estimates.row(v)[x] = kNoEstimate;
      }
  }
};

TEST(BoundThinHoles, AThinHoleIsSearchedBetweenTheEstimatesAroundIt) {
  Holes holes;
  holes.punch(10, 4);
  holes.punch(28, 3);
  holes.bound();
  // A hypothesis every 0.05 from -2 on: 1 is number 60, 2 is number 80.
  EXPECT_EQ(holes.bounds.row(20)[11].first, 60 - 8);
  EXPECT_EQ(holes.bounds.row(20)[11].last, 60 + 8);
  EXPECT_EQ(holes.bounds.row(20)[29].first, 60 - 8);
  EXPECT_EQ(holes.bounds.row(20)[29].last, 80 + 8);
}

TEST(BoundThinHoles, AWideHoleAndOtherPixelsKeepTheirBounds) {
  Holes holes;
  holes.punch(10, 9);
  holes.bound();
  for (const int u : {5, 14, 40}) {
    EXPECT_EQ(holes.bounds.row(20)[u].first, 0);
    EXPECT_EQ(holes.bounds.row(20)[u].last, 100);
  }
}

TEST(BoundThinHoles, NothingAroundLeavesTheFullRange) {
  Holes holes;
  holes.punch(0, 60);
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 60; ++u) {
      holes.estimates.row(v)[u] = kNoEstimate;
      holes.todo.row(v)[u] = v == 20;
    }
  holes.bound();
  EXPECT_EQ(holes.bounds.row(20)[30].last, 100);
}

}  // namespace
}  // namespace gigaray
