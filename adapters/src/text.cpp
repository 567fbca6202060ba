// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "text.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace gigaray {

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

std::vector<std::string> split_words(std::string_view line) {
  constexpr std::string_view kSeparators = " \t\r\n,;";
  std::vector<std::string> words;
  for (std::size_t begin = 0;
       words.size() < kMostWords &&
       (begin = line.find_first_not_of(kSeparators, begin)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    words.emplace_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 60;
  std::string text = "'" + std::string(word.substr(0, kMost)) + (word.size() > kMost ? "…'" : "'");
  for (std::size_t i = 0; i < std::min(word.size(), kMost) + 1; ++i)
    if (static_cast<unsigned char>(text[i]) < ' ' || text[i] == '\x7f') text[i] = '?';
  return text;
}

}  // namespace gigaray
