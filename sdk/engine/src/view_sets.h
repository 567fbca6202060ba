// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gigaray/core/ray_sampler.h"
#include "src/workspace.h"

namespace gigaray {

/// Views that a robust score is made of at most, and a first look. More hardly help (half of 81
/// views: docs/accuracy.md) and each costs the same.
inline constexpr int kMostViews = 100, kFirstViews = 25;
/// Of views whose rays go each its own way: samples cost three times as much, and what stands far
/// away sees less of the same.
inline constexpr int kMostPosedViews = 32;

/// 1 for `ref` and for about `wanted` views, spread evenly over any order; for all if a few more.
inline std::vector<std::uint8_t> spread_views(int num_views, int ref, int wanted) {
  constexpr double kGoldenRatio = 0.61803398874989485;
  std::vector<std::uint8_t> members(num_views, 1);
  if (5 * num_views <= 8 * wanted) return members;
  for (int view = 0; view < num_views; ++view)
    members[view] = std::fmod(view * kGoldenRatio, 1.0) * num_views < wanted;
  members[ref] = 1;
  return members;
}

inline constexpr int kHalfPlanes = 8;
/// Fewer samples in a half-plane than this share of all views count as this many.
inline constexpr float kLeastHalfPlane = 1.0f / 3.0f;
/// Sums are divided by no less.
inline constexpr float kLeastFloor = 1e-3f;

/// Which of 8 half-planes of camera positions, 45 degrees apart and with their border, each view
/// lies in as seen from view `ref`: bit i for the half-plane around the direction of i · 45
/// degrees. What counts is where the views see a point move as it comes nearer, which any sampler
/// knows.
template <RaySampler S>
std::vector<std::uint8_t> half_planes(const S& sampler, int ref,
                                      const HypothesisRange& hypotheses) {
  constexpr double kDiagonal = 0.70710678118654752;
  constexpr std::array<std::array<double, 2>, kHalfPlanes> kDirections{{{1, 0},
                                                                        {kDiagonal, kDiagonal},
                                                                        {0, 1},
                                                                        {-kDiagonal, kDiagonal},
                                                                        {-1, 0},
                                                                        {-kDiagonal, -kDiagonal},
                                                                        {0, -1},
                                                                        {kDiagonal, -kDiagonal}}};
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

/// The other views of a ScoreViews as bytes: bit 0, the view counts; for half-planes bit i as
/// there, 0 for a view that is left out.
template <RaySampler S>
std::vector<std::uint8_t> score_members(const S& sampler, int ref, ScoreViews views,
                                        const HypothesisRange& hypotheses) {
  const int most = S::kRaysShiftAlike ? kMostViews : kMostPosedViews;
  const int wanted = views == ScoreViews::kFirst ? kFirstViews : most;
  std::vector<std::uint8_t> members = spread_views(sampler.num_views(), ref, wanted);
  members[ref] = 0;  // it agrees with itself under any hypothesis
  if (views != ScoreViews::kHalfPlanes) return members;
  const std::vector<std::uint8_t> planes = half_planes(sampler, ref, hypotheses);
  for (std::size_t view = 0; view < members.size(); ++view)
    members[view] = members[view] ? planes[view] : 0;
  return members;
}

}  // namespace gigaray
