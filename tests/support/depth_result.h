// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "gigaray/engine/reconstruct.h"

namespace gigaray::testing_support {

/// Everything that a reconstruction says.
struct DepthResult {
  std::map<int, ViewDepth> views;
  std::vector<RayTuple> tuples;
};

inline DepthResult all_of(const Reconstruction& reconstruction) {
  DepthResult result;
  for (const int view : reconstruction.views()) result.views[view] = reconstruction.view(view);
  reconstruction.for_each_tuple([&](const RayTuple& tuple) { result.tuples.push_back(tuple); });
  return result;
}

inline bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
inline bool same_bits(const FloatMap& a, const FloatMap& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](float x, float y) { return same_bits(x, y); });
}
inline bool same_bits(const RayTuple& a, const RayTuple& b) {
  return same_bits(a.hypothesis, b.hypothesis) && same_bits(a.confidence, b.confidence) &&
         same_bits(a.radiance.r, b.radiance.r) && same_bits(a.radiance.g, b.radiance.g) &&
         same_bits(a.radiance.b, b.radiance.b) && a.view == b.view && a.u == b.u && a.v == b.v &&
         a.level == b.level;
}

/// Expects the same maps and the same tuples in the same order, to the last bit.
inline void expect_identical(const DepthResult& a, const DepthResult& b, const std::string& what) {
  ASSERT_EQ(a.views.size(), b.views.size()) << what;
  for (const auto& [view, depth] : a.views) {
    const ViewDepth& other = b.views.at(view);
    EXPECT_TRUE(same_bits(depth.disparity, other.disparity))
        << what << ", disparity of view " << view;
    EXPECT_TRUE(same_bits(depth.confidence, other.confidence))
        << what << ", confidence, view " << view;
    EXPECT_TRUE(depth.level == other.level) << what << ", level of view " << view;
  }
  ASSERT_EQ(a.tuples.size(), b.tuples.size()) << what;
  std::size_t same = 0;
  while (same < a.tuples.size() && same_bits(a.tuples[same], b.tuples[same])) ++same;
  EXPECT_EQ(same, a.tuples.size()) << what << ": first tuple that differs";
}

/// Share of pixels of all views within `tolerance` of the truth.
inline double share_within(const DepthResult& result, const std::vector<FloatMap>& truth,
                           double tolerance) {
  long good = 0, all = 0;
  for (const auto& [view, depth] : result.views)
    for (std::size_t i = 0; i < depth.disparity.size(); ++i) {
      ++all;
      good += std::abs(depth.disparity.data()[i] - truth[view].data()[i]) <= tolerance;
    }
  return double(good) / double(all);
}

inline long pixels_without_estimate(const DepthResult& result) {
  long count = 0;
  for (const auto& [view, depth] : result.views)
    for (std::size_t i = 0; i < depth.disparity.size(); ++i)
      count += !std::isfinite(depth.disparity.data()[i]) ||
               !std::isfinite(depth.confidence.data()[i]) || depth.level.data()[i] < 0;
  return count;
}

}  // namespace gigaray::testing_support
