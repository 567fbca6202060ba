// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gigaray {

/// Where a camera stands, any unit, right and down as the pictures show it.
struct CameraPosition {
  double right = 0;
  double down = 0;
};

/// Reads a positions file (docs/formats.md) for these pictures, in their order. Throws
/// Error(kBadInput) naming file and line: not a number, not finite, too few or too many lines, an
/// unknown or missing name.
std::vector<CameraPosition> read_positions(const std::filesystem::path& path,
                                           const std::vector<std::filesystem::path>& pictures);
/// The same of the text of a file; `where` begins the messages.
std::vector<CameraPosition> parse_positions(std::string_view text, const std::string& where,
                                            const std::vector<std::filesystem::path>& pictures);

}  // namespace gigaray
