// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "gigaray/light_field.h"

namespace gigaray::cli {

/// --focal-px, --baseline, --focus-distance and --unit: the rig of views on a line or in a plane,
/// where the input doesn't say, or in place of what it says.
struct RigOptions {
  std::optional<double> focal_px;        ///< of the pictures as they are, before --max-size
  std::optional<double> baseline;        ///< scene units per view step
  std::optional<double> focus_distance;  ///< scene units
  std::string unit;                      ///< empty: not stated

  void add_to(CLI::App& app);
  /// The first option that was given and that cameras with poses state already; empty: none.
  std::string stated() const;
  /// Puts what was stated into the light field, whose pictures have their own size, and notes what
  /// it takes the place of. Throws Error(kInvalidArgument) for views with cameras and for values
  /// that can't be meant.
  void apply(LightField& light_field) const;

 private:
  void change_unit(LightField& light_field) const;
};

}  // namespace gigaray::cli
