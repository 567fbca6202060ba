// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/times_in_names.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace gigaray {
namespace {

bool is_date(std::uint64_t year, std::uint64_t month, std::uint64_t day) {
  return year >= 1970 && year <= 2100 && month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

bool is_time_of_day(std::uint64_t hour, std::uint64_t minute, std::uint64_t second) {
  return hour <= 23 && minute <= 59 && second <= 60;
}

/// 20240501
bool is_compact_date(std::uint64_t number) {
  return is_date(number / 10000, number / 100 % 100, number % 100);
}

/// 120301
bool is_compact_time(std::uint64_t number) {
  return is_time_of_day(number / 10000, number / 100 % 100, number % 100);
}

/// Is this number of the pattern a fraction of the one before it, as in "12-00-00.123"?
bool is_fraction(const std::string& pattern, std::size_t column) {
  std::size_t at = pattern.find('#');
  for (std::size_t i = 0; i < column && at != std::string::npos; ++i)
    at = pattern.find('#', at + 1);
  return at != std::string::npos && at >= 2 && pattern[at - 1] == '.' && pattern[at - 2] == '#';
}

/// How many numbers of a name from `at` on are a time; 0: none.
std::size_t time_at(const NumberedPicture& picture, std::size_t at) {
  constexpr std::size_t kDate = 8, kTime = 6, kWithMilliseconds = 9, kSinceEpoch = 10, kYear = 4;
  constexpr std::uint64_t kOdd = ~std::uint64_t(0);  // no part of any time
  const auto number = [&](std::size_t i) {
    return at + i < picture.numbers.size() ? picture.numbers[at + i] : kOdd;
  };
  const auto digits = [&](std::size_t i) {
    return at + i < picture.digits.size() ? picture.digits[at + i] : 0;
  };
  const auto is_time = [&](std::size_t i) {
    return (digits(i) == kTime && is_compact_time(number(i))) ||
           (digits(i) == kWithMilliseconds && is_compact_time(number(i) / 1000));
  };
  if (digits(0) == kDate && is_compact_date(number(0))) return is_time(1) ? 2 : 1;
  if (digits(0) == kDate + kTime)
    return is_compact_date(number(0) / 1'000'000) && is_compact_time(number(0) % 1'000'000);
  if (digits(0) == kSinceEpoch) return is_fraction(picture.pattern, at + 1) ? 2 : 0;
  if (digits(0) != kYear || !is_date(number(0), number(1), number(2))) return 0;
  // A date alone may as well be a year, a row and a column.
  return is_time(3) ? 4 : is_time_of_day(number(3), number(4), number(5)) ? 6 : 0;
}

}  // namespace

std::set<std::size_t> time_columns(const NameGroup& group) {
  std::set<std::size_t> columns;
  if (group.pictures.empty()) return columns;
  for (std::size_t at = 0; at < group.pictures.front().numbers.size();) {
    std::size_t count = time_at(group.pictures.front(), at);
    for (const NumberedPicture& picture : group.pictures)
      count = std::min(count, time_at(picture, at));
    if (count > 1 && is_fraction(group.pictures.front().pattern, at + count)) ++count;
    for (std::size_t i = 0; i < count; ++i) columns.insert(at + i);
    at += std::max<std::size_t>(count, 1);
  }
  return columns;
}

std::optional<NamesInOrder> names_in_order(const NameGroup& group) {
  const std::set<std::size_t> times = time_columns(group);
  const std::vector<NumberedPicture>& pictures = group.pictures;
  // The numbers alone of a time, from left to right: the largest unit first.
  const auto time_of = [&](const NumberedPicture& picture) {
    std::vector<std::uint64_t> numbers;
    for (const std::size_t column : times) numbers.push_back(picture.numbers[column]);
    return numbers;
  };
  for (std::size_t i = 1; i < pictures.size(); ++i)
    if (time_of(pictures[i]) < time_of(pictures[i - 1])) return std::nullopt;

  std::vector<std::size_t> counters;
  std::ranges::set_difference(group.changing, times, std::back_inserter(counters));
  NamesInOrder order;
  for (const std::size_t column : counters)
    for (std::size_t i = 1; i < pictures.size(); ++i)
      if (pictures[i].numbers[column] <= pictures[i - 1].numbers[column]) return std::nullopt;
  if (!counters.empty()) {
    for (const NumberedPicture& picture : pictures)
      order.numbers.push_back(picture.numbers[counters.front()]);
    return order;
  }
  for (std::size_t i = 1; i < pictures.size(); ++i)
    if (time_of(pictures[i]) == time_of(pictures[i - 1])) return std::nullopt;
  order.are_times = !group.changing.empty();
  order.numbers.resize(pictures.size());
  std::iota(order.numbers.begin(), order.numbers.end(), std::uint64_t(0));
  return order;
}

}  // namespace gigaray
