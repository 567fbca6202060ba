// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <charconv>
#include <string>

namespace gigaray {

/// "origin 500100 4649800 200": digits enough to be read back as the same numbers.
inline std::string origin_text(const Eigen::Vector3d& origin) {
  std::string text = "origin";
  for (const double value : origin) {
    char digits[400];  // the longest double without an exponent
    text += ' ';
    text.append(digits,
                std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed).ptr);
  }
  return text;
}

}  // namespace gigaray
