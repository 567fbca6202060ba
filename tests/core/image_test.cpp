// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/image.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

TEST(Image, ASizeThatCannotBeMeantIsAnError) {
  for (const auto& [width, height, channels] :
       {std::tuple(-1, 5, 1), {5, -1, 1}, {5, 5, 0}, {5, 5, -1}, {-1, -1, 1}})
    expect_error(ErrorCode::kInvalidArgument, {std::to_string(width), std::to_string(height)},
                 [&, w = width, h = height, c = channels] { FloatMap(w, h, c); });
  expect_error(ErrorCode::kInvalidArgument, {"7 × 5", "34"},
               [] { FloatMap(7, 5, 1, std::vector<float>(34)); });
  expect_error(ErrorCode::kInvalidArgument, {"-7"},
               [] { FloatMap(-7, -5, 1, std::vector<float>(35)); });
}

TEST(Image, ASizeBeyondMemoryIsAnErrorOfMemory) {
  constexpr int kMost = std::numeric_limits<int>::max();
  for (const int channels : {1, 1000, kMost})
    expect_error(ErrorCode::kOutOfMemory, {std::to_string(kMost), "memory"},
                 [&] { Image<double>(kMost, kMost, channels); });
}

TEST(Image, NoPixelsAreAPicture) {
  EXPECT_TRUE(FloatMap(0, 5).empty());
  EXPECT_EQ(FloatMap(7, 5, 3).size(), 105u);
  EXPECT_EQ(FloatMap(2, 1, 1, {1, 2})(1, 0), 2);
}

}  // namespace
}  // namespace gigaray
