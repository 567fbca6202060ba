// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gigaray/ray_sampler.h"

namespace gigaray {

/// Views that a first look asks, and how many they may be before it leaves some out.
inline constexpr int kSomeViews = 25, kManyViews = 40;

/// 1 for about kSomeViews views, spread evenly over any order, and for `ref`; of few views for all.
inline std::vector<std::uint8_t> some_views(int num_views, int ref) {
  constexpr double kGoldenRatio = 0.61803398874989485;
  std::vector<std::uint8_t> members(num_views, 1);
  if (num_views <= kManyViews) return members;
  for (int view = 0; view < num_views; ++view)
    members[view] = std::fmod(view * kGoldenRatio, 1.0) * num_views < kSomeViews;
  members[ref] = 1;
  return members;
}

inline constexpr int kHalfPlanes = 8;
/// Fewer samples in a half-plane than this share of all views count as this many.
inline constexpr float kLeastHalfPlane = 1.0f / 3.0f;

/// Which of 8 half-planes of camera positions, 45 degrees apart and with their border, each view lies
/// in as seen from view `ref`: bit i for the half-plane around the direction of i · 45 degrees. What
/// counts is where the views see a point move as it comes nearer, which any sampler knows.
template <RaySampler S>
std::vector<std::uint8_t> half_planes(const S& sampler, int ref, const HypothesisRange& hypotheses) {
  constexpr double kDiagonal = 0.70710678118654752;
  constexpr std::array<std::array<double, 2>, kHalfPlanes> kDirections{
      {{1, 0}, {kDiagonal, kDiagonal}, {0, 1}, {-kDiagonal, kDiagonal},
       {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}}};
  constexpr double kOnBorder = 1e-4;
  std::vector<std::uint8_t> planes(sampler.num_views(), 0xff);
  for (int view = 0; view < sampler.num_views(); ++view) {
    const auto far = sampler.locate(ref, view, Ray{0, 0, hypotheses.min});
    const auto near = sampler.locate(ref, view, Ray{0, 0, hypotheses.max});
    if (!far || !near) continue;
    const double du = near->u - far->u, dv = near->v - far->v;
    for (int i = 0; i < kHalfPlanes; ++i)
      if (kDirections[i][0] * du + kDirections[i][1] * dv < -kOnBorder)
        planes[view] &= std::uint8_t(~(1u << i));
  }
  return planes;
}

}  // namespace gigaray
