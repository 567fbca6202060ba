// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// Value of an option as a file, a command line or another language states it: nothing (an optional
/// one that is left open), yes or no, a number, several, or words. Words may also hold any of the
/// others, as in "3", "true", "-1 2".
using OptionValue = std::variant<std::monostate, bool, int, double, std::vector<int>,
                                 std::vector<double>, std::string>;

/// name: with dots where structs are nested, as in "winner.median_radius".
struct NamedValue {
  std::string name;
  OptionValue value;
  bool operator==(const NamedValue&) const = default;
};

}  // namespace gigaray
