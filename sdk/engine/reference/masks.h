// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "src/estimates.h"
#include "src/strip_map.h"

namespace gigaray {

/// Least or greatest of a pixel and its four neighbours; outside the picture nothing counts. `in`
/// has one row more on both sides where the picture has it.
void erode(RowRange rows, int height, MapView<const std::uint8_t> in, MapView<std::uint8_t> out);
void dilate(RowRange rows, int height, MapView<const std::uint8_t> in, MapView<std::uint8_t> out);

/// Opening of a mask by a diamond that reaches `radius` px. 1: a cross of 3 px, which removes
/// isolated pixels and keeps lines of two. mask: rows of `rows` and 2 radius more on both sides
/// where the picture has them. Returns the rows of `rows`.
StripMap<std::uint8_t> open_mask(const StripMap<std::uint8_t>& mask, RowRange rows, int height,
                                 int radius = 1);

/// Pixels within `radius` (a square) of a pixel to do, with bounds that cover those of all such
/// pixels: where scores are needed so that support finds them.
void grow_todo(int radius, int height, StripMap<std::uint8_t>& todo,
               StripMap<HypothesisBounds>& bounds);

/// Estimates carried over from other views leave cracks where a surface is wider in this one. Fills
/// holes of up to `width` pixels in a row or a column between two estimates no more than `apart`
/// apart, evenly from one to the other. Returns what was filled; confidence: the lower of the two.
StripMap<std::uint8_t> close_cracks(int width, float apart, StripMap<float>& estimates,
                                    StripMap<float>& confidence);

/// Pixels within `reach` (a square) of two neighbouring estimates that differ by more than `jump`.
StripMap<std::uint8_t> beside_jumps(const StripMap<float>& map, float jump, int reach);

}  // namespace gigaray
