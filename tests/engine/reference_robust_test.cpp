// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What `auto` adds to the paper's steps, in the reference: half-planes of views and scan-lines.
#include <gtest/gtest.h>

#include <algorithm>

#include "gigaray/samplers/any_sampler.h"
#include "reference/ray_mean.h"
#include "reference/robust_score.h"
#include "reference/scanline.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

using reference::Band;
using reference::Scores;

constexpr float kRounding = 1e-6f;

Band flat_band(const std::vector<View>& views, int width, int height) {
  Band band{{0, width, height}, {0, height}, int(views.size()), 5, {}};
  band.data.assign(std::size_t(width) * height * views.size() * 5, 0);
  for (int v = 0; v < height; ++v)
    for (int view = 0; view < int(views.size()); ++view)
      for (int c = 0; c < 3; ++c) std::fill_n(band.plane(view, v, c), width, 0.5f);
  return band;
}

TEST(HalfPlanes, HoldTheViewsOnOneSideAndThoseOnTheirBorder) {
  const auto views = grid_of_views(3, 3);  // t outer, s inner; the centre is view 4
  const auto planes = half_planes(GridSampler(views), 4, {-1, 1, 3});
  EXPECT_EQ(planes[4], 0xff) << "the reference view is on all borders";
  for (int i = 0; i < kHalfPlanes; ++i) {
    int members = 0;
    for (const std::uint8_t plane : planes) members += plane >> i & 1;
    EXPECT_EQ(members, 6) << "half-plane " << i;
    // The opposite half-plane holds the others and the border.
    for (int view = 0; view < 9; ++view)
      EXPECT_TRUE((planes[view] >> i & 1) || (planes[view] >> (i + 4) % 8 & 1));
  }
  // Of a row the half-planes across are all views, the others its two sides.
  const auto row = half_planes(EpiSampler(row_of_views(5)), 2, {-1, 1, 3});
  for (const std::uint8_t plane : row) EXPECT_TRUE(plane & 1 << 2 && plane & 1 << 6);
  EXPECT_EQ((row[0] & 1) + (row[4] & 1), 1);
}

TEST(SpreadViews, AreAllOfFewAndAboutAsManyAsWantedOfMany) {
  const auto count = [](const std::vector<std::uint8_t>& members) {
    return std::count(members.begin(), members.end(), 1);
  };
  EXPECT_EQ(count(spread_views(33, 16, kFirstViews)), 33);
  EXPECT_EQ(count(spread_views(81, 40, kMostViews)), 81);
  for (const int views : {41, 81, 100, 289}) {
    for (const int ref : {0, 7, views / 2}) {
      const auto members = spread_views(views, ref, kFirstViews);
      EXPECT_EQ(members[ref], 1);
      EXPECT_NEAR(double(count(members)), kFirstViews, 4);
      // Spread over the views: every quarter of them has its share.
      for (int i = 0; i < 4; ++i)
        EXPECT_GE(
            std::count(members.begin() + i * views / 4, members.begin() + (i + 1) * views / 4, 1),
            4);
    }
  }
}

TEST(ScoreMembers, OfHalfPlanesLeaveOutWhatTheScoreLeavesOut) {
  const GridSampler sampler(grid_of_views(17, 17));
  const HypothesisRange range{-1, 1, 3};
  const auto all = score_members(sampler, 144, ScoreViews::kAll, range);
  const auto halves = score_members(sampler, 144, ScoreViews::kHalfPlanes, range);
  for (int view = 0; view < 289; ++view) EXPECT_EQ(all[view] != 0, halves[view] != 0) << view;
  EXPECT_EQ(all[144], 0) << "the reference agrees with itself under any hypothesis";
}

TEST(RayMean, TakesTheNoiseOffButNotTheOccluder) {
  // Eight views agree on 0.5, the reference view is off by 0.01, two show an occluder.
  const auto views = row_of_views(11);
  Band band = flat_band(views, 21, 3);
  for (int v = 0; v < 3; ++v) {
    for (int c = 0; c < 3; ++c) std::fill_n(band.plane(5, v, c), 21, 0.51f);
    for (const int view : {0, 1}) std::fill_n(band.plane(view, v, 0), 21, 0.9f);
  }
  ScoreOptions score = auto_options().score;
  score.bandwidth = 0.1f;
  StripMap<float> disparity(21, {0, 3}), means(21, {0, 15});
  disparity.row(1)[3] = kNoEstimate;
  reference::ray_mean(band, EpiSampler(views), 5, {0, 3}, score, disparity, means);
  const float weight = 1 - 0.01f * std::sqrt(3.0f) / score.bandwidth;
  EXPECT_NEAR(means.row(5)[10], (8 * weight * 0.5f + 0.51f) / (8 * weight + 1), 1e-5);
  EXPECT_EQ(means.row(5)[3], 0.51f) << "no estimate: it stays as it is";
}

TEST(RobustScore, OfTheBestHalfPlaneIgnoresAnOccluderOnOneSide) {
  const auto views = grid_of_views(5, 5);
  const GridSampler sampler(views);
  Band band = flat_band(views, 31, 31);
  // The views to the right see another colour.
  for (int view = 0; view < 25; ++view)
    if (views[view].s > 0)
      for (int v = 0; v < 31; ++v) std::fill_n(band.plane(view, v, 0), 31, 0.9f);
  const ScoreOptions score = auto_options().score;
  const Ray ray{15, 15, 0.5};
  const auto planes = half_planes(sampler, 12, {-1, 1, 3});
  const std::vector<std::uint8_t> all(25, 1);
  const auto own = band.pixel(12, 15, 15);
  EXPECT_NEAR(reference::robust_score(band, sampler, 12, ray, own, score, all, 1), 15.0 / 25,
              kRounding);
  EXPECT_NEAR(reference::robust_score(band, sampler, 12, ray, own, score, planes, kHalfPlanes), 1,
              kRounding);
}

TEST(RobustScore, AnOccluderDoesNotScoreByItsGradient) {
  const ScoreOptions score = auto_options().score;
  const reference::Sample own{0.5f, 0.5f, 0.5f, 0.01f, 0};
  EXPECT_NEAR(reference::robust_kernel(own, own, score), 1, kRounding);
  reference::Sample other = own;
  other[0] += TAIL_WIDTH * score.bandwidth;
  EXPECT_EQ(reference::robust_kernel(other, own, score), 0) << "same gradient, another colour";
  other = own;
  other[0] += 2 * score.bandwidth;
  EXPECT_LT(reference::robust_kernel(other, own, score), 0.35f) << "in the tail";
  other = own;
  other[3] += 2 * score.gradient_bandwidth;
  EXPECT_NEAR(reference::robust_kernel(other, own, score), 1 - score.gradient_share, kRounding);
}

TEST(RobustScore, SteepTextureMayBeResampledDifferently) {
  ScoreOptions score = auto_options().score;
  score.colour_slack = 1;
  score.gradient_slack = 0.5f;
  reference::Sample flat{0.5f, 0.5f, 0.5f, 0, 0}, steep{0.5f, 0.5f, 0.5f, 0.03f, 0.04f};
  reference::Sample beside_flat = flat, beside_steep = steep;
  beside_flat[0] += score.bandwidth;
  beside_steep[0] += score.bandwidth + 0.05f;
  EXPECT_NEAR(reference::robust_kernel(beside_steep, steep, score),
              reference::robust_kernel(beside_flat, flat, score), 1e-5);
  beside_steep = steep;
  beside_steep[3] += score.gradient_bandwidth + 0.025f;
  EXPECT_NEAR(reference::robust_kernel(beside_steep, steep, score), 1 - score.gradient_share,
              kRounding);
}

TEST(RobustScore, WhatNoOtherViewSeesSaysAsMuchAsIsAsked) {
  const auto views = row_of_views(2);
  const Band band = flat_band(views, 21, 3);
  const EpiSampler sampler(views);
  ScoreOptions score = auto_options().score;
  score.unseen = 0.1f;
  const auto members = score_members(sampler, 0, ScoreViews::kAll, {-1, 4, 3});
  const double outside = sampler.locate(0, 1, Ray{1, 1, 4})->u < 0 ? 4 : -4;
  EXPECT_NEAR(reference::robust_score(band, sampler, 0, Ray{1, 1, outside}, band.pixel(0, 1, 1),
                                      score, members, 1),
              0.1, kRounding);
}

TEST(RobustScore, WhatNoOtherViewSeesIsNeitherLikelyNorUnlikely) {
  const auto views = row_of_views(2);
  const Band band = flat_band(views, 21, 3);
  const EpiSampler sampler(views);
  const ScoreOptions score = auto_options().score;
  const auto members = score_members(sampler, 0, ScoreViews::kAll, {-1, 4, 3});
  const auto own = band.pixel(0, 1, 1);
  const auto at = [&](double h) {
    return reference::robust_score(band, sampler, 0, Ray{1, 1, h}, own, score, members, 1);
  };
  EXPECT_NEAR(at(0), 1, kRounding) << "the other view agrees";
  const double outside = sampler.locate(0, 1, Ray{1, 1, 4})->u < 0 ? 4 : -4;
  EXPECT_NEAR(at(outside), score.unseen, kRounding);
}

/// A strip of one row; every pixel scores `most` at its hypothesis and `other` elsewhere.
struct PathRow {
  static constexpr int kCount = 12;
  Band band;
  Scores scores;
  StripMap<std::uint8_t> todo;

  explicit PathRow(int width)
      : band(flat_band(row_of_views(1), width, 1)),
        scores({0, 1}, kCount, width),
        todo(width, {0, 1}) {
    std::fill(scores.data.begin(), scores.data.end(), 0.2f);
    std::fill_n(todo.row(0), width, 1);
  }
  int winner(int u, const SupportOptions& options) const {
    const Scores sum = reference::scanline(band, 0, {0, 1}, options, todo, scores);
    int best = 0;
    for (int i = 1; i < kCount; ++i)
      if (sum.at(u, 0, i) > sum.at(u, 0, best)) best = i;
    return best;
  }
};

TEST(Scanline, CarriesAnAnswerOverPixelsThatScoreAlike) {
  PathRow row(21);
  for (const int u : {0, 1, 2, 18, 19, 20}) row.scores.at(u, 0, 7) = 0.9f;
  const SupportOptions options = auto_options().support;
  for (int u = 0; u < 21; ++u) EXPECT_EQ(row.winner(u, options), 7) << u;
  // A pixel that is not to do ends the path.
  row.todo.row(0)[2] = row.todo.row(0)[18] = 0;
  EXPECT_EQ(row.winner(10, options), 0);
}

TEST(Scanline, AJumpIsCheapWhereTheColourChanges) {
  PathRow row(20);
  for (int u = 0; u < 20; ++u) {
    row.scores.at(u, 0, u < 10 ? 2 : 9) = 0.5f;
    if (u >= 10)
      for (int c = 0; c < 3; ++c) row.band.plane(0, 0, c)[u] = 0.9f;
  }
  const SupportOptions options = auto_options().support;
  EXPECT_EQ(row.winner(9, options), 2);
  EXPECT_EQ(row.winner(10, options), 9);
}

TEST(Scanline, SmallStepsArePricedByTheirSize) {
  // A surface that rises by a hypothesis per two pixels keeps its own winners.
  PathRow row(20);
  for (int u = 0; u < 20; ++u) row.scores.at(u, 0, 1 + u / 2) = 0.6f;
  for (int u = 0; u < 20; ++u) EXPECT_EQ(row.winner(u, auto_options().support), 1 + u / 2) << u;
}

TEST(Scanline, RowsBeyondTheReachOfABlockChangeNothing) {
  const int height = 5 * kScanlineBlock;
  const RowRange block{2 * kScanlineBlock, 3 * kScanlineBlock};
  const Band band = flat_band(row_of_views(1), 3, height);
  StripMap<std::uint8_t> todo(3, {0, height});
  Scores scores({0, height}, 5, 3);
  for (int v = 0; v < height; ++v) {
    std::fill_n(todo.row(v), 3, 1);
    for (int u = 0; u < 3; ++u)
      for (int i = 0; i < 5; ++i) scores.at(u, v, i) = 0.1f * float((3 * u + 5 * v + 7 * i) % 10);
  }
  const SupportOptions options = auto_options().support;
  const Scores before = reference::scanline(band, 0, block, options, todo, scores);
  for (int u = 0; u < 3; ++u)
    for (int i = 0; i < 5; ++i) scores.at(u, block.begin - kScanlineReach - 1, i) = 9;
  const Scores after = reference::scanline(band, 0, block, options, todo, scores);
  EXPECT_EQ(before.data, after.data);
}

}  // namespace
}  // namespace gigaray::testing_support
