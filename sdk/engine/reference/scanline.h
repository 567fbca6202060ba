// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "density_score.h"

namespace gigaray::reference {

/// Sum over the four directions of the best score of a path to the pixel (scanline.cl). rows: of
/// the result, begin at a multiple of SCANLINE_BLOCK; scores and todo: SCANLINE_REACH rows more.
Scores scanline(const Band& band, int ref, RowRange rows, const SupportOptions& options,
                MapView<const std::uint8_t> todo, const Scores& scores);

}  // namespace gigaray::reference
