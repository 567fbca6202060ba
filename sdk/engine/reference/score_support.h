// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Scores of `rows` supported by their neighbours, weighed by colour and distance.
Scores score_support(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                     const StripMap<std::uint8_t>& todo, const StripMap<HypothesisBounds>& bounds,
                     const Scores& scores);

}  // namespace gigaray::reference
