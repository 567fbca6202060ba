// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "formats/numbered_names.h"

namespace gigaray {

/// Which numbers of the names are parts of a time: 20240501_120301 and 20230101_123456789, a date
/// and a time in six numbers, 20240501120301, seconds since 1970 with a fraction.
std::set<std::size_t> time_columns(const NameGroup& group);

/// What orders a group of pictures in whose names one number or several change together.
struct NamesInOrder {
  std::vector<std::uint64_t> numbers;  ///< of the pictures in the group's order: rising
  bool are_times = false;              ///< the names hold times alone: the numbers only count
};

/// Empty when the numbers that change give no single order: a grid, or counters that disagree.
std::optional<NamesInOrder> names_in_order(const NameGroup& group);

}  // namespace gigaray
