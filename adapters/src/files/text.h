// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gigaray {

/// The whole text as a number, whatever the locale; NaN and infinities are numbers. Empty if it is
/// anything else.
std::optional<double> parse_number(std::string_view text);

/// Text without white space at both ends.
std::string_view trimmed(std::string_view text);

/// Lower case of ASCII letters.
std::string lower(std::string text);

/// Upper case of ASCII letters.
std::string upper(std::string text);

/// Words between white space, commas and semicolons: the first kMostWords of them, which is more
/// than any line has that is meant.
inline constexpr std::size_t kMostWords = 1000;
std::vector<std::string> split_words(std::string_view line);

/// A word of a file for a message: in quotes, shortened, control characters replaced.
std::string in_quotes(std::string_view word);

/// What a file of text holds as UTF-8: a byte order mark is taken away, UTF-16 with one is
/// converted.
std::string as_utf8(std::string bytes);

}  // namespace gigaray
