// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Scores of `rows` supported by their neighbours, weighed by colour and distance.
Scores score_support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                     MapView<const std::uint8_t> todo, MapView<const HypothesisBounds> bounds,
                     const Scores& scores);

/// The same along the slope of the surface: a neighbour counts with its score at the hypothesis
/// that the surface through the pixel has there, linearly interpolated.
Scores slanted_support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                       const HypothesisRange& hypotheses, MapView<const std::uint8_t> todo,
                       MapView<const HypothesisBounds> bounds, MapView<const Slope> slopes,
                       const Scores& scores);

}  // namespace gigaray::reference
