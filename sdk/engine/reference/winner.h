// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Winner (eq. 6), refined if asked, and its contrast: best score minus mean score.
void winner(RowRange rows, const Scores& scores, const HypothesisRange& hypotheses, bool refine,
            const StripMap<std::uint8_t>& todo, const StripMap<HypothesisBounds>& bounds,
            StripMap<float>& disparity, StripMap<float>& contrast);

}  // namespace gigaray::reference
