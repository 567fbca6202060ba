// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/camera_position.h"

#include <string>

namespace gigaray {
namespace {

struct Step {
  int right = 0, down = 0;
};

Step step(Travel way) {
  switch (way) {
    case Travel::kRight:
      return {1, 0};
    case Travel::kLeft:
      return {-1, 0};
    case Travel::kDown:
      return {0, 1};
    case Travel::kUp:
      return {0, -1};
    case Travel::kAuto:
      break;
  }
  GIGARAY_CHECK(way != Travel::kAuto);
  return {};
}

bool is_sideways(Travel way) { return way == Travel::kRight || way == Travel::kLeft; }

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::kInvalidArgument, "OpenOptions::direction: " + what);
}

}  // namespace

Directions Directions::of_series(const OpenOptions& options, Travel usual) {
  if (options.row_direction != Travel::kAuto)
    refuse("a series of pictures goes one way; state one, not two");
  const bool stated = options.direction != Travel::kAuto;
  const Travel way = stated ? options.direction : usual;
  return {way, is_sideways(way) ? Travel::kDown : Travel::kRight, stated};
}

Directions Directions::of_grid(const OpenOptions& options, Travel usual_columns,
                               Travel usual_rows) {
  if (options.direction == Travel::kAuto) return {usual_columns, usual_rows, false};
  if (options.row_direction == Travel::kAuto)
    refuse("a grid needs two ways, as the column rises and as the row rises: right,down");
  if (is_sideways(options.direction) == is_sideways(options.row_direction))
    refuse("columns and rows of a grid can't go along the same line");
  return {options.direction, options.row_direction, true};
}

void Directions::place(View& view, double column, double row) const {
  const Step c = step(columns_), r = step(rows_);
  // + 0.0: never -0.
  place_camera(view, c.right * column + r.right * row + 0.0, c.down * column + r.down * row + 0.0);
}

void refuse_direction(const OpenOptions& options, const char* what) {
  if (options.direction != Travel::kAuto)
    refuse(std::string(what) + " where the cameras stand; leave the option out");
}

}  // namespace gigaray
