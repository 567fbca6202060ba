// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/path_text.h"

#include <glib.h>

#include <charconv>

namespace gigaray {
namespace {

constexpr std::string_view kScheme = "file:";

/// Where the UTF-8 at the begin of a text ends.
std::size_t utf8_size(std::string_view text) {
  const char* end = nullptr;
  g_utf8_validate(text.data(), gssize(text.size()), &end);
  return std::size_t(end - text.data());
}

/// The text with bytes that are no UTF-8, and those of ASCII that `is_bad` names, percent-encoded.
template <class IsBad>
std::string encoded(std::string_view text, IsBad is_bad) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string result;
  std::size_t valid = utf8_size(text);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (i < valid && !is_bad(byte)) {
      result += text[i];
      continue;
    }
    result += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    if (i >= valid) valid = i + 1 + utf8_size(text.substr(i + 1));
  }
  return result;
}

}  // namespace

std::string path_text(const std::filesystem::path& path) {
  const std::string& text = path.native();
  if (utf8_size(text) == text.size() && !text.starts_with(kScheme)) return text;
  return std::string(kScheme) + encoded(text, [](unsigned char byte) { return byte == '%'; });
}

std::filesystem::path path_of_text(std::string_view text) {
  if (!text.starts_with(kScheme)) return text;
  text.remove_prefix(kScheme.size());
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      path += char(byte);
      i += 2;
    } else {
      path += text[i];
    }
  }
  return path;
}

std::string view_name_of(std::string_view name) {
  return encoded(name, [](unsigned char byte) { return byte < ' ' || byte == 0x7f; });
}

std::string shell_word(const std::filesystem::path& path) {
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

}  // namespace gigaray
