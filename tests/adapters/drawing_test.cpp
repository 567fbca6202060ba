// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gigaray {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

int count_colour(const Image<std::uint16_t>& picture, std::array<int, 3> colour) {
  int count = 0;
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u)
      count += picture(u, v, 0) == colour[0] && picture(u, v, 1) == colour[1] &&
               picture(u, v, 2) == colour[2];
  return count;
}

EpiDrawing green_epi(int rows, int columns) {
  EpiDrawing epi;
  epi.pixels = Image<std::uint16_t>(columns, rows, 3);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u) epi.pixels(u, v, 1) = 200;
  epi.first_u = 17;
  epi.reference_u = 17 + columns / 2;
  epi.reference_row = rows / 2;
  for (int row = 0; row < rows; ++row) {
    epi.s.push_back(row - rows / 2);
    epi.line.push_back(epi.reference_u - epi.s.back());
  }
  return epi;
}

TEST(Drawing, AnEpiIsEnlargedAndKeepsItsColours) {
  const Image<std::uint16_t> drawn = draw_epi(green_epi(7, 93));
  EXPECT_GT(drawn.width(), 3 * 93);
  EXPECT_GT(drawn.height(), 3 * 7);
  EXPECT_GT(count_colour(drawn, {0, 200, 0}), drawn.width() * drawn.height() / 2);
  EXPECT_TRUE(std::all_of(drawn.begin(), drawn.end(), [](int value) { return value <= 255; }));
}

TEST(Drawing, TheLineOfAnEpiFollowsThePoint) {
  EpiDrawing epi = green_epi(9, 61);
  const Image<std::uint16_t> with = draw_epi(epi);
  std::fill(epi.line.begin(), epi.line.end(), double(kNaN));
  const Image<std::uint16_t> without = draw_epi(epi);
  ASSERT_EQ(with.width(), without.width());
  // It leans to the left as s grows: where it differs from the drawing without, u falls with v.
  double first = 0, last = 0;
  for (int v = 0; v < with.height(); ++v) {
    double sum = 0, count = 0;
    for (int u = 0; u < with.width(); ++u)
      if (with(u, v, 1) != without(u, v, 1)) {
        sum += u;
        ++count;
      }
    if (count == 0) continue;
    if (first == 0) first = sum / count;
    last = sum / count;
  }
  EXPECT_GT(first, last + with.width() / 20);
}

TEST(Drawing, SamplesStandAtTheirViews) {
  const std::vector<SampleCell> cells{{-1, 0, {1, 0, 0}, false},
                                      {0, 0, {0, 1, 0}, true},
                                      {1, 2, {0, 0, 1}, false},
                                      {1, 0, {kNaN, kNaN, kNaN}, false}};
  const Image<std::uint16_t> drawn = draw_samples(cells);
  const auto middle = [&](std::array<int, 3> colour) {
    double u_sum = 0, v_sum = 0, count = 0;
    for (int v = 0; v < drawn.height(); ++v)
      for (int u = 0; u < drawn.width(); ++u)
        if (drawn(u, v, 0) == colour[0] && drawn(u, v, 1) == colour[1] &&
            drawn(u, v, 2) == colour[2])
          u_sum += u, v_sum += v, ++count;
    EXPECT_GT(count, 0);
    return std::pair(u_sum / count, v_sum / count);
  };
  const auto [red_u, red_v] = middle({255, 0, 0});
  const auto [green_u, green_v] = middle({0, 255, 0});
  const auto [blue_u, blue_v] = middle({0, 0, 255});
  EXPECT_NEAR(green_u - red_u, blue_u - green_u, 2);
  EXPECT_GT(green_u, red_u + 5);
  EXPECT_NEAR(red_v, green_v, 1);
  EXPECT_NEAR(blue_v - green_v, 2 * (green_u - red_u), 2);
}

TEST(Drawing, AScoreCurveShowsItsPeakAndItsGaps) {
  std::vector<float> scores(81, 0.2f);
  scores[40] = 0.9f;
  const std::vector<ScoreMark> marks{{"winner", 0.0}};
  const Image<std::uint16_t> drawn = draw_scores(scores, {-1, 1}, 0.21, marks);
  constexpr std::array<int, 3> kCurve{31, 119, 180};
  const int whole = count_colour(drawn, kCurve);
  EXPECT_GT(whole, 400);
  for (int i = 0; i < 30; ++i) scores[i] = -1;
  for (int i = 50; i < 81; ++i) scores[i] = kNaN;
  const int middle = count_colour(draw_scores(scores, {-1, 1}, 0.21, marks), kCurve);
  EXPECT_LT(middle, whole);
  EXPECT_GT(middle, 0);
}

TEST(Drawing, ACurveWithoutAnyScoreIsStillDrawn) {
  const std::vector<float> scores(5, -1.0f);
  EXPECT_GT(draw_scores(scores, {-2, 3}, kNaN, {}).width(), 100);
}

}  // namespace
}  // namespace gigaray
