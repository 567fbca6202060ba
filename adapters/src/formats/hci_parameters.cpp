// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/hci_parameters.h"

#include <cmath>
#include <sstream>

#include "files/text.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

std::string_view unquoted(std::string_view word) {
  word = trimmed(word);
  const bool is_quoted = word.size() >= 2 && (word.front() == '"' || word.front() == '\'') &&
                         word.front() == word.back();
  return is_quoted ? trimmed(word.substr(1, word.size() - 2)) : word;
}

}  // namespace

HciParameters::HciParameters(std::string_view text, std::string where) : where_(std::move(where)) {
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    // What stands behind ; or # is a comment.
    const std::string_view words = std::string_view(line).substr(0, line.find_first_of(";#"));
    const auto equals = words.find_first_of("=:");
    if (equals == std::string::npos) continue;
    values_[lower(std::string(unquoted(words.substr(0, equals))))] =
        unquoted(words.substr(equals + 1));
  }
}

std::optional<double> HciParameters::number(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  const auto value = parse_number(found->second);
  if (!value || !std::isfinite(*value))
    throw Error(ErrorCode::kBadInput,
                where_ + ": " + key + " = " + in_quotes(found->second) + " is not a finite number");
  return value;
}

int HciParameters::cameras(const std::string& key, int usual) const {
  const double value = number(key).value_or(usual);
  if (value < 1 || value > 1000 || value != std::floor(value))
    throw Error(ErrorCode::kBadInput, where_ + ": " + key + " is no number of cameras");
  return int(value);
}

}  // namespace gigaray
