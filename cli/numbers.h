// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace gigaray::cli {

/// Checks of options that are numbers without an upper end; CLI11's own state its 309 digits.
inline CLI::Validator number_check(const char* what, bool allows_zero) {
  return CLI::Validator(
      [what, allows_zero](const std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
        return is_number && (value > 0 || (allows_zero && value == 0))
                   ? std::string()
                   : "is " + text + "; it must be a number " + what;
      },
      "");
}
inline CLI::Validator above_zero() { return number_check("above 0", false); }
inline CLI::Validator zero_or_more() { return number_check("of 0 or more", true); }

}  // namespace gigaray::cli
