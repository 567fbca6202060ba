// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "reference/masks.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace gigaray {
namespace {

using Picture = std::vector<std::string>;  // rows; '#' is set

StripMap<std::uint8_t> mask_of(const Picture& picture) {
  StripMap<std::uint8_t> mask(int(picture[0].size()), {0, int(picture.size())});
  for (int v = 0; v < int(picture.size()); ++v)
    for (int u = 0; u < mask.width(); ++u) mask.row(v)[u] = picture[v][u] == '#';
  return mask;
}

Picture picture_of(const StripMap<std::uint8_t>& mask) {
  Picture picture;
  for (int v = mask.rows().begin; v < mask.rows().end; ++v) {
    picture.emplace_back();
    for (int u = 0; u < mask.width(); ++u) picture.back() += mask.row(v)[u] ? '#' : '.';
  }
  return picture;
}

Picture opened(const Picture& picture) {
  return picture_of(open_mask(mask_of(picture), {0, int(picture.size())}, int(picture.size())));
}

TEST(OpenMask, DropsIsolatedPixelsAndThinLines) {
  EXPECT_EQ(opened({".......",  //
                    ".#...#.",  //
                    ".....#.",  //
                    ".......",  //
                    "#.###.."}),
            (Picture{".......", ".......", ".......", ".......", "......."}));
}

TEST(OpenMask, KeepsWhatACrossFitsIn) {
  const Picture cross = {".....", "..#..", ".###.", "..#..", "....."};
  EXPECT_EQ(opened(cross), cross);
  const Picture full(5, "#######");
  EXPECT_EQ(opened(full), full) << "the border of the picture takes nothing away";
}

TEST(OpenMask, IsIdempotentAndNeverAdds) {
  std::mt19937 random(7);
  Picture picture(23, std::string(37, '.'));
  for (auto& row : picture)
    for (char& pixel : row) pixel = random() % 4 ? '#' : '.';
  const Picture once = opened(picture);
  EXPECT_NE(once, Picture(23, std::string(37, '.')));
  EXPECT_EQ(opened(once), once);
  for (std::size_t v = 0; v < once.size(); ++v)
    for (std::size_t u = 0; u < once[v].size(); ++u)
      EXPECT_FALSE(once[v][u] == '#' && picture[v][u] == '.');
}

TEST(OpenMask, ALargerDiamondTakesWiderLines) {
  StripMap<std::uint8_t> mask(40, {0, 30});
  for (int v = 5; v < 25; ++v) {
    for (int u = 4; u < 10; ++u) mask.row(v)[u] = 1;   // six wide
    for (int u = 20; u < 27; ++u) mask.row(v)[u] = 1;  // seven wide
  }
  const StripMap<std::uint8_t> open = open_mask(mask, {0, 30}, 30, 3);
  for (int u = 0; u < 40; ++u) EXPECT_EQ(open.row(15)[u], u >= 20 && u < 27) << u;
}

TEST(OpenMask, ABandGivesTheSameRowsAsThePicture) {
  std::mt19937 random(8);
  Picture picture(19, std::string(21, '.'));
  for (auto& row : picture)
    for (char& pixel : row) pixel = random() % 4 ? '#' : '.';
  const Picture whole = opened(picture);
  for (int begin = 0; begin < 19; begin += 4) {
    const RowRange band{begin, std::min(begin + 4, 19)}, around = grown(band, 2, 19);
    StripMap<std::uint8_t> strip(21, around);
    for (int v = around.begin; v < around.end; ++v)
      for (int u = 0; u < 21; ++u) strip.row(v)[u] = picture[v][u] == '#';
    EXPECT_EQ(picture_of(open_mask(strip, band, 19)),
              Picture(whole.begin() + band.begin, whole.begin() + band.end));
  }
}

TEST(GrowTodo, GrowsASquareAndCoversAllBounds) {
  StripMap<std::uint8_t> todo(9, {0, 7});
  StripMap<HypothesisBounds> bounds(9, {0, 7});
  todo.row(3)[2] = todo.row(5)[6] = 1;
  bounds.row(3)[2] = {4, 9};
  bounds.row(5)[6] = {7, 20};
  grow_todo(2, 7, todo, bounds);
  for (int v = 0; v < 7; ++v)
    for (int u = 0; u < 9; ++u) {
      const bool first = std::abs(u - 2) <= 2 && std::abs(v - 3) <= 2;
      const bool second = std::abs(u - 6) <= 2 && std::abs(v - 5) <= 2;
      ASSERT_EQ(todo.row(v)[u] != 0, first || second) << u << ", " << v;
      if (!first && !second) continue;
      const HypothesisBounds expected{std::uint16_t(first ? 4 : 7), std::uint16_t(second ? 20 : 9)};
      EXPECT_EQ(bounds.row(v)[u], expected) << u << ", " << v;
    }
}

TEST(CloseCracks, NarrowHolesOfOneSurfaceAreFilledEvenly) {
  StripMap<float> estimates(9, {0, 3}), confidence(9, {0, 3});
  for (int v = 0; v < 3; ++v)
    for (int u = 0; u < 9; ++u) {
      estimates.row(v)[u] = u < 6 ? 1 + 0.01f * float(u) : 3;
      confidence.row(v)[u] = 0.1f * float(u);
    }
  estimates.row(1)[2] = estimates.row(1)[3] = kNoEstimate;                        // a crack
  estimates.row(0)[5] = estimates.row(1)[5] = estimates.row(2)[5] = kNoEstimate;  // beside a jump
  estimates.row(2)[0] = kNoEstimate;                                              // at the edge
  const auto filled = close_cracks(2, 0.1f, estimates, confidence);
  EXPECT_NEAR(estimates.row(1)[2], 1.02, 1e-6);
  EXPECT_NEAR(estimates.row(1)[3], 1.03, 1e-6);
  EXPECT_NEAR(confidence.row(1)[3], 0.1, 1e-6);
  EXPECT_TRUE(filled.row(1)[2] && filled.row(1)[3]);
  for (int v = 0; v < 3; ++v) EXPECT_TRUE(std::isnan(estimates.row(v)[5])) << v;
  EXPECT_TRUE(std::isnan(estimates.row(2)[0]));
  EXPECT_EQ(filled.row(2)[0] + filled.row(0)[5], 0);
}

TEST(CloseCracks, AColumnFillsWhatNoRowCanAndWideHolesStay) {
  StripMap<float> estimates(7, {0, 5}), confidence(7, {0, 5});
  for (int v = 0; v < 5; ++v)
    for (int u = 0; u < 7; ++u) estimates.row(v)[u] = v == 2 ? kNoEstimate : 2.0f;
  close_cracks(1, 0.1f, estimates, confidence);
  for (int u = 0; u < 7; ++u) EXPECT_EQ(estimates.row(2)[u], 2);
  for (int u = 0; u < 7; ++u) estimates.row(2)[u] = estimates.row(3)[u] = kNoEstimate;
  close_cracks(1, 0.1f, estimates, confidence);
  for (int u = 0; u < 7; ++u) EXPECT_TRUE(std::isnan(estimates.row(2)[u])) << u;
}

}  // namespace
}  // namespace gigaray
