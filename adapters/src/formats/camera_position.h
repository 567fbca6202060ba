// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/adapters/reader.h"
#include "gigaray/core/light_field.h"

namespace gigaray {

/// Puts a view where its camera stands: `right` and `down` of the origin, as the picture shows
/// right and down (see View).
inline void place_camera(View& view, double right, double down) {
  view.s = right;
  view.t = down;
}

/// Which way the camera goes as the numbers of a format rise: from the options, else as the format
/// has it. Together with place_camera the one place where adapters convert directions into s and t.
class Directions {
 public:
  /// One number. `usual`: the way when the options don't state one. Throws
  /// Error(kInvalidArgument) when they state two.
  static Directions of_series(const OpenOptions& options, Travel usual);
  /// Two numbers: column or x, and row or y. Throws Error(kInvalidArgument) when the options state
  /// one way only, or two along the same line.
  static Directions of_grid(const OpenOptions& options, Travel usual_columns, Travel usual_rows);

  bool stated() const { return stated_; }
  /// `column` and `row`: numbers or coordinates from the origin, same unit.
  void place(View& view, double column, double row) const;

 private:
  Directions(Travel columns, Travel rows, bool stated)
      : columns_(columns), rows_(rows), stated_(stated) {}
  Travel columns_, rows_;
  bool stated_;
};

/// For formats that state positions: throws Error(kInvalidArgument), naming `what` states them,
/// when the options state a direction too.
void refuse_direction(const OpenOptions& options, const char* what);

}  // namespace gigaray
