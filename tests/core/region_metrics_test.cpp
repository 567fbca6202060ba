// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/region_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

FloatMap row_of(std::initializer_list<float> values) {
  FloatMap map(int(values.size()), 1);
  std::copy(values.begin(), values.end(), map.begin());
  return map;
}

/// f(u, v) for every pixel.
template <class F>
FloatMap map_of(int width, int height, F f) {
  FloatMap map(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) map(u, v) = float(f(u, v));
  return map;
}

Mask everywhere(const FloatMap& map) { return Mask(map.width(), map.height(), 1, 1); }

TEST(RegionMetrics, BadPixCountsTheMaskAloneAndMissingEstimatesAsBad) {
  const FloatMap truth(5, 1, 1, 1.0f);
  const FloatMap estimate = row_of({1, 1.125f, kNaN, 9, 1.0625f});
  Mask mask(5, 1, 1, 1);
  mask(3, 0) = 0;
  EXPECT_DOUBLE_EQ(bad_pix(estimate, truth, 0.07, 0, mask), 50);
  EXPECT_DOUBLE_EQ(bad_pix(estimate, truth, 0.05, 0, mask), 75);
}

TEST(RegionMetrics, AnEmptyRegionHasNoScore) {
  const FloatMap map(7, 7);
  const Mask none(7, 7);
  EXPECT_TRUE(std::isnan(bad_pix(map, map, 0.07, 0, none)));
  EXPECT_TRUE(std::isnan(bumpiness(map, map, 0, none)));
  EXPECT_TRUE(std::isnan(mean_squared_error_x100(map, map, 0, none)));
  EXPECT_TRUE(std::isnan(fine_fattening(map, map, 9, everywhere(map))));
}

TEST(RegionMetrics, FatteningIsTooNearAndThinningTooFar) {
  const FloatMap truth(5, 1, 1, 0.0f);
  const FloatMap estimate = row_of({0.25f, 0.125f, -0.125f, -0.25f, -0.5f});
  EXPECT_DOUBLE_EQ(fine_fattening(estimate, truth, 0, everywhere(truth)), 20);
  EXPECT_DOUBLE_EQ(fine_thinning(estimate, truth, 0, everywhere(truth)), 40);
}

TEST(RegionMetrics, BackgammonComparesWithTheMiddleOfForegroundAndBackground) {
  // Foreground 2 on the left, background 0 on the right; between them a wedge of disparity 2.
  const FloatMap truth = map_of(41, 3, [](int u, int) { return u < 20 || u == 25 ? 2 : 0; });
  FloatMap estimate = truth;
  estimate(24, 1) = 1.25f;  // beside the wedge, closer to the foreground
  estimate(26, 1) = 0.75f;
  estimate(25, 1) = 0.75f;  // on the wedge, closer to the background
  Mask beside(41, 3), on(41, 3);
  for (int v = 0; v < 3; ++v) beside(24, v) = beside(26, v) = on(25, v) = 1;
  EXPECT_DOUBLE_EQ(backgammon_fattening(estimate, truth, 0, beside), 100 / 6.0);
  EXPECT_DOUBLE_EQ(backgammon_thinning(estimate, truth, 0, on), 100 / 3.0);
  EXPECT_THROW(backgammon_fattening(FloatMap(9, 3), FloatMap(9, 3), 0, Mask(9, 3)), Error);
}

TEST(RegionMetrics, AMissedDotIsHalfWrong) {
  // Two boxes, each with a dot of size 1 (two pixels) and a dot of size 2 (one pixel).
  const FloatMap truth(8, 1, 1, 0.0f);
  LabelMap boxes(8, 1), dots(8, 1);
  for (int u = 0; u < 8; ++u) boxes(u, 0) = u < 4 ? 3 : 7;
  dots(0, 0) = dots(1, 0) = dots(4, 0) = dots(5, 0) = 1;
  dots(2, 0) = dots(6, 0) = 2;
  dots(3, 0) = 9;  // too large to be scored
  EXPECT_EQ(missed_dots(truth, truth, boxes, dots), 0);
  FloatMap estimate = truth;
  estimate(0, 0) = 0.5f;   // half of the first dot
  estimate(6, 0) = 0.25f;  // not off enough
  estimate(3, 0) = 9;
  EXPECT_EQ(missed_dots(estimate, truth, boxes, dots), 25);
  estimate(6, 0) = kNaN;
  EXPECT_EQ(missed_dots(estimate, truth, boxes, dots), 50);
  EXPECT_THROW(missed_dots(estimate, truth, LabelMap(3, 3), dots), Error);
}

TEST(RegionMetrics, MeanSquaredErrorLeavesMissingEstimatesOut) {
  const FloatMap truth(3, 1, 1, 0.0f);
  EXPECT_DOUBLE_EQ(mean_squared_error_x100(row_of({0.5f, kNaN, 0}), truth, 0, everywhere(truth)),
                   12.5);
}

TEST(Bumpiness, AnOffsetAndATiltAreSmooth) {
  const FloatMap truth = map_of(11, 9, [](int u, int v) { return 0.5 * u - 0.25 * v; });
  const FloatMap estimate = map_of(11, 9, [](int u, int v) { return 0.75 * u + 0.5 * v + 3; });
  EXPECT_EQ(bumpiness(estimate, truth, 2, everywhere(truth)), 0);
}

TEST(Bumpiness, OfAParabolaIsFourTimesItsSecondDerivative) {
  // Second derivative 1/512 px along u: Scharr's weights give four times that, times 100.
  const FloatMap truth(11, 9, 1, 1.0f);
  const FloatMap estimate = map_of(11, 9, [](int u, int) { return 1 + u * u / 1024.0; });
  EXPECT_NEAR(bumpiness(estimate, truth, 2, everywhere(truth)), 400 / 512.0, 1e-9);
  // A saddle u v / 512 has that derivative twice, off the diagonal.
  const FloatMap saddle = map_of(11, 9, [](int u, int v) { return 1 + u * v / 512.0; });
  EXPECT_NEAR(bumpiness(saddle, truth, 2, everywhere(truth)), std::sqrt(2) * 400 / 512.0, 1e-9);
}

TEST(Bumpiness, IsLimitedAndSkipsWhatIsNotKnown) {
  const FloatMap truth(15, 15, 1, 0.0f);
  FloatMap estimate = truth;
  estimate(7, 7) = 100;
  Mask mask(15, 15);
  mask(7, 7) = 1;
  EXPECT_DOUBLE_EQ(bumpiness(estimate, truth, 0, mask), 5);
  estimate(7, 7) = kNaN;
  EXPECT_TRUE(std::isnan(bumpiness(estimate, truth, 0, mask)));
  mask(2, 2) = 1;
  EXPECT_EQ(bumpiness(estimate, truth, 0, mask), 0);
}

TEST(AngularError, IsZeroForTheTruthAndNeedsARig) {
  const FloatMap truth = map_of(13, 11, [](int u, int v) { return 0.01 * u * v; });
  RigGeometry rig;
  EXPECT_TRUE(std::isnan(median_angular_error(truth, truth, rig, 0, everywhere(truth))));
  rig.focal_px = 500;
  rig.baseline = 0.01;
  rig.focus_distance = 2;
  EXPECT_NEAR(median_angular_error(truth, truth, rig, 0, everywhere(truth)), 0, 1e-5);
}

TEST(AngularError, OfATiltedPlaneIsItsAngle) {
  // Depth z = 1 / (a + b u) is a plane: with x = k u z, 1 = a z + (b / k) x, whose normal is
  // (b / k, 0, a). Against a frontal plane the angle is atan(b / (k a)).
  const int width = 21;
  RigGeometry rig;
  rig.focal_px = 40;
  rig.baseline = 0.1;
  rig.focus_distance = 2;
  const double strength = 40 * 0.1, a = 0.5, b = 0.005;
  const double k = 0.5 * width / (width - 1) / 40;
  const FloatMap frontal(width, 15, 1, 0.0f);  // z = 2 everywhere
  const FloatMap tilted = map_of(width, 15, [&](int u, int) { return strength * b * u; });
  const double angle = std::atan(b / (k * a)) * 180 / std::numbers::pi;
  EXPECT_GT(angle, 30);
  // Central differences of the hyperbola in u are off by a small part of its curvature.
  EXPECT_NEAR(median_angular_error(tilted, frontal, rig, 1, everywhere(frontal)), angle, 0.01);
}

TEST(NearJumps, IsADiscAroundBothSides) {
  const FloatMap truth = map_of(21, 1, [](int u, int) { return u < 10 ? 0.0 : 0.2; });
  const Mask mask = mask_near_jumps(truth);
  for (int u = 0; u < 21; ++u) EXPECT_EQ(mask(u, 0), u >= 9 - 4 && u <= 10 + 4) << u;
  const Mask none =
      mask_near_jumps(map_of(21, 3, [](int u, int v) { return 0.1 * u + (u == 4 ? kNaN : 0); }));
  for (const auto value : none) EXPECT_EQ(value, 0) << "a slope and a hole are no jumps";
}

TEST(RegionMetrics, SizesThatDifferAreAnError) {
  const FloatMap map(7, 5), other(5, 7);
  EXPECT_THROW(bad_pix(other, map, 0.07, 0, Mask(7, 5)), Error);
  EXPECT_THROW(bumpiness(map, map, 0, Mask(5, 7)), Error);
  EXPECT_THROW(median_angular_error(other, map, {}, 0, Mask(7, 5)), Error);
  EXPECT_THROW(fine_thinning(map, map, -1, Mask(7, 5)), Error);
}

}  // namespace
}  // namespace gigaray
