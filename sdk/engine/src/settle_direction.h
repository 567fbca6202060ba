// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace gigaray {

/// What check_direction() finds.
struct SettledDirection {
  DisparityRange range;  ///< estimated, in the new positions
  std::string message;   ///< for the user; empty: a row stays as it was assumed
  bool is_clear = true;  ///< the pictures tell near from far
};

/// As check_direction(), without a word. Empty: the direction was stated.
std::optional<SettledDirection> settle_direction(LightField& light_field,
                                                 const RunControl& control);

}  // namespace gigaray
