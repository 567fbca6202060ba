// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <span>

#include "gigaray/core/ray_sampler.h"
#include "src/estimates.h"
#include "src/strip_map.h"
#include "src/workspace.h"

namespace gigaray {

/// Depth bounds of one level down (section 4.5). A pixel without an estimate gets the least and the
/// greatest of the nearest reliable estimates to its left and right; a side without one leaves the
/// bound open (the full range). A coarse pixel joins those of its finer pixels.
///   estimates, search  two fine rows (or one, at the bottom of an odd height), width values each;
///                      search is empty at level 0
///   coarse             (width + 1) / 2 values
void coarsen_bounds(std::span<const PackedEstimate> estimates, std::span<const Search> search,
                    int width, const HypothesisRange& range, std::span<Search> coarse);

/// Holes thinner than 7 px between estimates carried over from other views show, as a rule, one of
/// the surfaces around them. Their pixels get narrower bounds: from the least to the greatest
/// estimate around, with a margin in which a peak of the score and what lies beside it find room.
///   todo, estimates  of a whole view; an estimate is NaN where there is none
///   wide             todo opened by kThinHole, which leaves the other pixels
void bound_thin_holes(RowRange rows, MapView<const std::uint8_t> todo,
                      MapView<const std::uint8_t> wide, MapView<const float> estimates,
                      const HypothesisRange& range, MapView<HypothesisBounds> bounds);

/// The hypotheses from `low` to `high`, which may lie between them or beyond the range, and
/// `margin` more on both sides.
HypothesisBounds hypotheses_between(float low, float high, int margin,
                                    const HypothesisRange& range);

/// The hypotheses between the bounds of a search, one more on both sides.
HypothesisBounds bounds_of(const Search& search, const HypothesisRange& range);

}  // namespace gigaray
