// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "formats/camera_position.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace gigaray {

/// Views of a complete grid, row by row, named view_RR_CC. The middle of the grid is the origin;
/// a column is one view step, a row is row_step of them.
std::vector<View> grid_views(int rows, int columns, const Directions& directions,
                             double row_step = 1);

/// Row and column of a number from 0 on in a grid.
struct GridCell {
  int row = 0, column = 0;
};
GridCell cell_of(int number, const GridSize& grid);

/// Says that the directions of a grid without a stated one are assumed.
void assume_directions(LightField& light_field, const Directions& directions);

/// Makes a light field of these pictures, one per view, without those that are much darker than the
/// view in the middle: the rim of the lens hides the scene from them. They go to
/// LightField::left_out, with a note. Throws Error(kBadInput) when all are black.
void attach_bright_views(LightField& light_field, std::vector<Image<std::uint16_t>> pictures,
                         int bit_depth);

/// The same of pictures in files, in a plane. Vignetting reaches the corners of a grid first: where
/// they are bright no other picture is decoded.
void leave_out_dark_views(LightField& light_field);

}  // namespace gigaray
