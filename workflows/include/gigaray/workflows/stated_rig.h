// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// The rig of views on a line or in a plane, where the input doesn't say, or in place of what it
/// says.
struct StatedRig {
  std::optional<double> focal_px = {};  ///< of the pictures as they are, before they are shrunk
  std::optional<double> baseline = {};  ///< scene units per view step
  std::optional<double> focus_distance = {};  ///< scene units
  std::string unit = {};                      ///< empty: not stated

  /// The first field that is set and that cameras with poses state already; empty: none.
  std::string stated() const;
  /// Puts what was stated into the light field, whose pictures have their own size, and notes what
  /// it takes the place of. Throws Error(kInvalidArgument) for views with cameras and for values
  /// that can't be meant.
  void apply(LightField& light_field) const;

 private:
  void change_unit(LightField& light_field) const;
};

}  // namespace gigaray
