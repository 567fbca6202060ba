// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cstdint>

#include "gigaray/core/image.h"
#include "gigaray/core/ray_sampler.h"

namespace gigaray {

/// First and last hypothesis to test at a pixel.
struct HypothesisBounds {
  std::uint16_t first = 0;
  std::uint16_t last = 0;
  bool operator==(const HypothesisBounds&) const = default;
};

/// An estimate packed so that the larger number is the one that stays where two meet: the nearer
/// hypothesis, then the higher confidence. 0: none.
using PackedEstimate = std::uint64_t;
PackedEstimate pack_estimate(float hypothesis, float confidence);
float hypothesis_of(PackedEstimate estimate);  ///< NaN for none
float confidence_of(PackedEstimate estimate);
/// What an arrival must exceed in confidence at a pixel of a finished view that has `own`
/// (PropagationOptions::finished_lead); below 0 where it has none.
float bar_of(PackedEstimate own, float finished_lead);

/// How an estimate changes from pixel to pixel, hypothesis units per px.
struct Slope {
  float along_u = 0, along_v = 0;
};

/// What a pixel of a coarser level knows from the finer ones.
struct Search {
  float low = kNoEstimate;   ///< Bounds of its search; NaN: it needs none, all finer pixels have
  float high = kNoEstimate;  ///< an estimate
  float known_low =
      kNoEstimate;  ///< Least and greatest estimate of the finer pixels that have one;
  float known_high = kNoEstimate;  ///< NaN: none has
};

/// Rows around a pixel that slope_fit looks at.
inline constexpr int kSlopeReach = 15;
/// Rows around a pixel that side_evidence looks at, and choose_sides.
inline constexpr int kSideReach = 18, kSideColours = 3;
/// Rows around a pixel that find_hidden looks at, and find_specks.
inline constexpr int kHiddenReach = 16, kSpeckReach = 5;
/// The scan-line step follows columns in blocks of so many rows,
inline constexpr int kScanlineBlock = 16;
/// and looks at so many rows on both sides of a block.
inline constexpr int kScanlineReach = 16;
/// The winner of a scan-line step is the best score so near to it, hypotheses.
inline constexpr int kScanlineSearch = 2;

/// Steps of a size, over a range, that find_hidden looks at.
inline int hidden_steps(const HypothesisRange& range, double apart) {
  constexpr double kMost = 4096;
  return 1 + int(std::min((range.max - range.min) / apart, kMost));
}

/// One pyramid level.
struct LevelShape {
  int level = 0;
  int width = 0;
  int height = 0;
  RowRange rows() const { return {0, height}; }
};

}  // namespace gigaray
