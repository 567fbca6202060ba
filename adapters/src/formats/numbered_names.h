// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace gigaray {

/// A picture and the numbers in its name.
struct NumberedPicture {
  std::filesystem::path path;
  std::string pattern;                 ///< The name with '#' for every number, then the extension.
  std::vector<std::uint64_t> numbers;  ///< Saturated; fractions of seconds since 1970 in ns.
  std::vector<std::size_t> digits;     ///< Of each number, with leading zeros.
  /// In front of each number: the letters that end there, lower case, without what separates them
  /// from it. "view_r03_c5" has "r", "c".
  std::vector<std::string> labels;
};

/// Ordered by pattern, then numbers, then name.
std::vector<NumberedPicture> numbered_pictures(const std::vector<std::filesystem::path>& pictures);

/// Pictures whose names differ in numbers only.
struct NameGroup {
  std::vector<NumberedPicture> pictures;  ///< By rising numbers; may be empty.
  std::set<std::size_t> changing;         ///< Which of the numbers are not the same in all names.
  /// First name of another group that is larger than half of this one; empty: none.
  std::string rival;

  std::string first_name() const { return pictures.front().path.filename().string(); }
};

/// The largest group; pictures without a number are in none.
NameGroup largest_group(const std::vector<std::filesystem::path>& pictures);

}  // namespace gigaray
