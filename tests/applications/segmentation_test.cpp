// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/segmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

TEST(Segment, TakesTheClosedIntervalAndNoUnknown) {
  FloatMap map(7, 1);
  const float values[] = {
      0.99f, 1, 1.5f, 2, 2.01f, kNoEstimate, std::numeric_limits<float>::infinity()};
  std::copy(std::begin(values), std::end(values), map.begin());
  Mask mask;
  segment(map, {1, 2}, mask);
  EXPECT_EQ(std::vector<std::uint8_t>(mask.begin(), mask.end()),
            (std::vector<std::uint8_t>{0, 1, 1, 1, 0, 0, 0}));
}

TEST(Segment, LargeMapsAreTheSameAsPixelByPixel) {
  FloatMap map(1733, 1409);
  for (std::size_t i = 0; i < map.size(); ++i)
    map.data()[i] = i % 11 == 0 ? kNoEstimate : float(i * 2654435761u % 1000) / 1000;
  Mask mask(3, 3);
  segment(map, {0.25f, 0.5f}, mask);
  ASSERT_EQ(mask.width(), 1733);
  ASSERT_EQ(mask.height(), 1409);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < map.size(); ++i)
    wrong += mask.data()[i] != (map.data()[i] >= 0.25f && map.data()[i] <= 0.5f);
  EXPECT_EQ(wrong, 0u);
}

/// A bright disc before a dark ground, and a mask that is up to 2 px off.
struct Disc {
  static constexpr int kSize = 97;
  Image<std::uint16_t> picture{kSize, kSize, 3};
  Mask truth{kSize, kSize}, mask{kSize, kSize};

  Disc() {
    for (int v = 0; v < kSize; ++v)
      for (int u = 0; u < kSize; ++u) {
        const double radius = std::hypot(u - 48, v - 48);
        truth(u, v) = radius < 30;
        mask(u, v) = radius < 30 + 2 * std::sin(0.7 * (u + v));
        for (int c = 0; c < 3; ++c) picture(u, v, c) = truth(u, v) ? 200 : 40;
      }
  }
};

TEST(SoftMatte, FollowsTheColoursNearTheEdgeAndNothingElse) {
  const Disc disc;
  const MatteOptions options;
  const FloatMap matte = soft_matte(disc.mask, disc.picture, 8, options);
  double error = 0, before = 0;
  for (int v = 0; v < Disc::kSize; ++v)
    for (int u = 0; u < Disc::kSize; ++u) {
      EXPECT_GE(matte(u, v), 0);
      EXPECT_LE(matte(u, v), 1);
      const double radius = std::hypot(u - 48, v - 48);
      const bool is_far_from_edge = std::abs(radius - 30) > 2 + options.radius + 1;
      EXPECT_TRUE(!is_far_from_edge || matte(u, v) == float(disc.mask(u, v))) << u << ", " << v;
      error += (matte(u, v) > 0.5f) != (disc.truth(u, v) != 0);
      before += disc.mask(u, v) != disc.truth(u, v);
    }
  EXPECT_LT(error, 0.3 * before);
}

TEST(SoftMatte, SixteenBitsGiveTheSame) {
  const Disc disc;
  Image<std::uint16_t> deep = disc.picture;
  for (std::uint16_t& value : deep) value = std::uint16_t(value * 257);
  const FloatMap a = soft_matte(disc.mask, disc.picture, 8, {});
  const FloatMap b = soft_matte(disc.mask, deep, 16, {});
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a.data()[i], b.data()[i], 1e-4);
}

TEST(SoftMatte, AbsurdOptionsAreRefused) {
  const Disc disc;
  for (const MatteOptions& options : {MatteOptions{0, 0.03f}, {65, 0.03f}, {6, 0}})
    expect_error(ErrorCode::kInvalidArgument, {"soft edge"},
                 [&] { soft_matte(disc.mask, disc.picture, 8, options); });
}

}  // namespace
}  // namespace gigaray
