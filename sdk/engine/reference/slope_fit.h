// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// Slope of the surface at every estimate: a robust plane through it and those around it. Weights
/// are Gaussians of colour and distance, times Tukey's biweight of the residual, with ever smaller
/// scale. step: between hypotheses, the unit of that scale; max_slope: hypothesis units per px.
void slope_fit(const Band& band, int ref, RowRange rows, float step, float max_slope,
               MapView<const std::uint8_t> todo, MapView<const float> in, MapView<Slope> slopes);

}  // namespace gigaray::reference
