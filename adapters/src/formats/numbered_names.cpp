// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/numbered_names.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "files/text.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

/// The letters that a piece of a name ends with: "cam-R_" gives "r".
std::string label_of(std::string piece) {
  piece = lower(std::move(piece));
  while (!piece.empty() && !is_letter(piece.back())) piece.pop_back();
  std::size_t begin = piece.size();
  while (begin > 0 && is_letter(piece[begin - 1])) --begin;
  return piece.substr(begin);
}

NumberedPicture numbered(const fs::path& path) {
  NumberedPicture result{path, "", {}, {}, {}};
  const std::string name = path.stem().string();
  std::string piece;  // since the last number
  for (std::size_t i = 0; i < name.size();) {
    if (!is_digit(name[i])) {
      piece += name[i];
      result.pattern += name[i++];
      continue;
    }
    std::uint64_t value = 0;
    constexpr std::uint64_t kLimit = std::numeric_limits<std::uint64_t>::max() / 10 - 1;
    std::size_t digits = 0;
    for (; i < name.size() && is_digit(name[i]); ++i, ++digits)
      value = value > kLimit ? value : value * 10 + std::uint64_t(name[i] - '0');
    result.digits.push_back(digits);
    // Seconds since 1970 with a fraction, whose digits count from the left: .5 is more than .123.
    constexpr std::uint64_t kSeconds = 1'000'000'000;
    constexpr std::size_t kNanoseconds = 9;
    if (piece == "." && !result.numbers.empty() && result.numbers.back() >= kSeconds)
      for (; digits < kNanoseconds; ++digits) value *= 10;
    result.pattern += '#';
    result.numbers.push_back(value);
    result.labels.push_back(label_of(std::exchange(piece, "")));
  }
  result.pattern += lower(path.extension().string());
  return result;
}

}  // namespace

std::vector<NumberedPicture> numbered_pictures(const std::vector<fs::path>& pictures) {
  std::vector<NumberedPicture> all;
  for (const fs::path& path : pictures) all.push_back(numbered(path));
  std::sort(all.begin(), all.end(), [](const NumberedPicture& a, const NumberedPicture& b) {
    return std::tie(a.pattern, a.numbers, a.path) < std::tie(b.pattern, b.numbers, b.path);
  });
  return all;
}

NameGroup largest_group(const std::vector<fs::path>& pictures) {
  std::map<std::string, std::vector<NumberedPicture>> groups;
  for (NumberedPicture& picture : numbered_pictures(pictures))
    if (!picture.numbers.empty()) groups[picture.pattern].push_back(std::move(picture));
  if (groups.empty()) return {};
  const auto largest = std::max_element(
      groups.begin(), groups.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  NameGroup group;
  group.pictures = largest->second;
  for (const auto& [pattern, other] : groups)
    if (pattern != largest->first && 2 * other.size() > group.pictures.size() &&
        group.rival.empty())
      group.rival = other.front().path.filename().string();
  const auto& first = group.pictures.front().numbers;
  for (const NumberedPicture& picture : group.pictures)
    for (std::size_t i = 0; i < first.size(); ++i)
      if (picture.numbers[i] != first[i]) group.changing.insert(i);
  return group;
}

}  // namespace gigaray
