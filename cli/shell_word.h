// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>

namespace gigaray::cli {

/// A path as one word of a shell, for lines that the user can copy: in quotes if it needs them.
inline std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string();
  // An option would begin like this.
  const std::string shown = text.starts_with('-') ? "./" + text : text;
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-,@%=:";
  if (!shown.empty() && shown.find_first_not_of(kPlain) == std::string::npos) return shown;
  std::string quoted = "'";
  for (const char letter : shown) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  return quoted + "'";
}

}  // namespace gigaray::cli
