// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Winner (eq. 6), refined if asked, and its contrast: best score minus mean score, less where the
/// peak is wide (WinnerOptions::peak_share). The largest of `chosen_by` decides, then the largest
/// score no farther than `search` hypotheses from it.
void winner(RowRange rows, const Scores& chosen_by, const Scores& scores, int search,
            const HypothesisRange& hypotheses, const WinnerOptions& options,
            MapView<const std::uint8_t> todo, MapView<const HypothesisBounds> bounds,
            MapView<float> disparity, MapView<float> contrast);

/// Score of the hypothesis next to each estimate; NaN where there is none or nothing to do.
void score_of_estimate(RowRange rows, const Scores& scores, const HypothesisRange& hypotheses,
                       MapView<const std::uint8_t> todo, MapView<const float> disparity,
                       MapView<float> out);

}  // namespace gigaray::reference
