// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "estimates.h"
#include "finished_maps.h"
#include "gigaray/engine/depth_options.h"
#include "strip_map.h"

namespace gigaray {

/// Is there one? Small pictures have too little at half the size, and one view has no other to
/// agree with.
bool is_guided(const LightField& light_field, const DepthOptions& options);

/// Where the views of posed photographs are to be searched, told by their maps of half the size
/// (docs/method.md, "Coarse guide"). A pixel whose surroundings other views agree on is searched
/// around what they say; one that they don't agree on between what is sure nearby; where
/// nothing is sure in a part of the range around its estimate.
class CoarseGuide {
 public:
  /// maps: of half the size, rounded up, of the views in the order in which they will be worked on,
  /// after view_consensus().
  explicit CoarseGuide(FinishedMaps maps) : maps_(std::move(maps)) {}

  /// Of rows of a view, at the full size. The same for a row whatever the others.
  StripMap<HypothesisBounds> bounds(int active_idx, int width, RowRange rows,
                                    const HypothesisRange& range) const;

  /// What the maps of half the size say, between their pixels; NaN: nothing.
  StripMap<float> hypotheses(int active_idx, int width, RowRange rows) const;

 private:
  FinishedMaps maps_;
};

}  // namespace gigaray
