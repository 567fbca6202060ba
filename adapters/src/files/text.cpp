// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "files/text.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace gigaray {
namespace {

void append_utf8(std::string& text, char32_t code) {
  const auto tail = [&](int shift) { text += char(0x80 | ((code >> shift) & 0x3f)); };
  if (code < 0x80) {
    text += char(code);
  } else if (code < 0x800) {
    text += char(0xc0 | (code >> 6));
    tail(0);
  } else if (code < 0x10000) {
    text += char(0xe0 | (code >> 12));
    tail(6);
    tail(0);
  } else {
    text += char(0xf0 | (code >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

/// low, high: which of two bytes is the lower one. The mark before the text is passed over.
std::string utf8_of_utf16(std::string_view bytes, std::size_t low, std::size_t high) {
  constexpr char32_t kSurrogate = 0xd800, kSecond = 0xdc00, kEnd = 0xe000;
  const auto unit = [&](std::size_t i) {
    return char32_t(static_cast<unsigned char>(bytes[i + low])) |
           char32_t(static_cast<unsigned char>(bytes[i + high])) << 8;
  };
  std::string text;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    char32_t code = unit(i);
    if (code >= kSurrogate && code < kSecond && i + 3 < bytes.size() && unit(i + 2) >= kSecond &&
        unit(i + 2) < kEnd) {
      code = 0x10000 + ((code - kSurrogate) << 10) + (unit(i + 2) - kSecond);
      i += 2;
    }
    append_utf8(text, code);
  }
  return text;
}

}  // namespace

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

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
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

std::string as_utf8(std::string bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) return bytes.substr(3);
  if (bytes.starts_with("\xff\xfe")) return utf8_of_utf16(bytes, 0, 1);
  if (bytes.starts_with("\xfe\xff")) return utf8_of_utf16(bytes, 1, 0);
  return bytes;
}

}  // namespace gigaray
