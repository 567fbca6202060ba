// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Getting, setting and checking a field of the table, whatever its type.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

#include "gigaray/core/error.h"
#include "gigaray/engine/option_table.h"

namespace gigaray {
namespace {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};

Error refused(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// The shortest decimal number that gives the same float, so that records read as they were meant.
double shortest(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double decimal = value;
  std::from_chars(text, end, decimal);
  return float(decimal) == value ? decimal : double(value);
}

std::string number_text(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// The whole text as a number, whatever the locale.
std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int> whole(double value) {
  constexpr double kMost = std::numeric_limits<int>::max();
  if (!(std::abs(value) <= kMost) || value != std::floor(value)) return std::nullopt;
  return int(value);
}

/// Numbers between white space and commas; empty where a word is none.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  constexpr std::string_view kBetween = " \t,";
  std::vector<double> numbers;
  while (true) {
    const auto begin = text.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) return numbers;
    text.remove_prefix(begin);
    const auto word = text.substr(0, text.find_first_of(kBetween));
    const auto number = number_of(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(word.size());
  }
}

const char* what_it_must_be(OptionType type) {
  switch (type) {
    case OptionType::kBool:
      return "true or false";
    case OptionType::kInteger:
      return "a whole number";
    case OptionType::kNumber:
      return "a number";
    case OptionType::kRange:
      return "two numbers, or none";
    case OptionType::kIndices:
      return "whole numbers, or none";
    case OptionType::kText:
      break;
  }
  return "a text";
}

/// Words as what they hold, for an option of this type; as they are where they hold no such thing.
OptionValue read_words(OptionType type, const std::string& words) {
  if (type == OptionType::kText) return words;
  if (type == OptionType::kBool) {
    for (const char* yes : {"true", "yes", "on", "1"})
      if (words == yes) return true;
    for (const char* no : {"false", "no", "off", "0"})
      if (words == no) return false;
    return words;
  }
  const bool may_be_none = type == OptionType::kRange || type == OptionType::kIndices;
  if (may_be_none && (words.empty() || words == "none")) return std::monostate();
  const auto numbers = numbers_of(words);
  if (!numbers || numbers->empty()) return words;
  if (may_be_none) return *numbers;
  if (numbers->size() == 1) return numbers->front();
  return words;
}

// What a value is as a field of a type; empty: nothing that it could be.
std::optional<bool> as_bool(const OptionValue& value) {
  const bool* yes = std::get_if<bool>(&value);
  return yes ? std::optional(*yes) : std::nullopt;
}
std::optional<double> as_number(const OptionValue& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  if (const double* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}
std::optional<int> as_integer(const OptionValue& value) {
  const auto number = as_number(value);
  return number ? whole(*number) : std::nullopt;
}
std::optional<std::vector<double>> as_numbers(const OptionValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return std::vector<double>();
  if (const auto number = as_number(value)) return std::vector<double>{*number};
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
  if (const auto* list = std::get_if<std::vector<int>>(&value))
    return std::vector<double>(list->begin(), list->end());
  return std::nullopt;
}

bool assign(bool& field, const OptionValue& value) {
  const auto found = as_bool(value);
  if (found) field = *found;
  return found.has_value();
}
bool assign(int& field, const OptionValue& value) {
  const auto found = as_integer(value);
  if (found) field = *found;
  return found.has_value();
}
template <class T>
requires std::is_floating_point_v<T>
bool assign(T& field, const OptionValue& value) {
  const auto found = as_number(value);
  if (found) field = T(*found);
  return found.has_value();
}
bool assign(std::optional<DisparityRange>& field, const OptionValue& value) {
  const auto found = as_numbers(value);
  if (!found || (found->size() != 0 && found->size() != 2)) return false;
  field.reset();
  if (!found->empty()) field = DisparityRange{found->at(0), found->at(1)};
  return true;
}
bool assign(std::vector<int>& field, const OptionValue& value) {
  const auto found = as_numbers(value);
  if (!found) return false;
  std::vector<int> indices;
  for (const double number : *found) {
    const auto index = whole(number);
    if (!index) return false;
    indices.push_back(*index);
  }
  field = indices;
  return true;
}
bool assign(std::string& field, const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text) field = *text;
  return text != nullptr;
}

/// Throws where a number is out of its bounds; in the type of the field, which rounds them alike.
template <class T>
void check_bounds(const DepthOption& option, T value) {
  using Bound = std::conditional_t<std::is_same_v<T, float>, float, double>;
  const Bound least = Bound(option.bounds.least), most = Bound(option.bounds.most);
  if ((option.bounds.or_zero && value == 0) || (value >= least && value <= most)) return;
  std::ostringstream text;
  text << option.name << " is ";
  const bool has_most = std::isfinite(option.bounds.most);
  if (std::isnan(double(value)) && !has_most)
    text << "not a number";
  else if (has_most)
    text << value << "; it must be between " << least << " and " << most
         << (option.bounds.or_zero ? ", or 0" : "");
  else
    text << value << "; it must not be negative";
  throw refused(text.str());
}

void check_range(const DepthOption& option, const DisparityRange& range) {
  std::ostringstream text;
  text << option.name << " range " << range.min << " " << range.max;
  if (!std::isfinite(range.min) || !std::isfinite(range.max))
    throw refused(text.str() + ": not finite numbers");
  if (range.min >= range.max) throw refused(text.str() + ": the first must be the smaller one");
}

void check_indices(const DepthOption& option, const std::vector<int>& indices) {
  for (const int index : indices)
    if (index < 0)
      throw refused(std::string(option.name) + ": view " + std::to_string(index) +
                    "; indices must not be negative");
}

template <class Call>
auto with_field(const DepthOption& option, DepthOptions& options, Call&& call) {
  return std::visit([&](auto access) { return call(access(options)); }, option.field);
}

/// Fields are reached through a function that may change them; this one is only looked at.
template <class Call>
auto with_field(const DepthOption& option, const DepthOptions& options, Call&& call) {
  return with_field(option, const_cast<DepthOptions&>(options),
                    [&](const auto& field) { return call(field); });
}

}  // namespace

const char* to_string(OptionType type) {
  constexpr const char* kNames[] = {"bool", "integer", "number", "range", "indices", "text"};
  return kNames[int(type)];
}

OptionType DepthOption::type() const {
  return std::visit(
      Overloaded{[](Access<bool>) { return OptionType::kBool; },
                 [](Access<int>) { return OptionType::kInteger; },
                 [](Access<float>) { return OptionType::kNumber; },
                 [](Access<double>) { return OptionType::kNumber; },
                 [](Access<std::optional<DisparityRange>>) { return OptionType::kRange; },
                 [](Access<std::vector<int>>) { return OptionType::kIndices; },
                 [](Access<std::string>) { return OptionType::kText; }},
      field);
}

OptionValue DepthOption::get(const DepthOptions& options) const {
  return with_field(
      *this, options,
      Overloaded{
          [](float value) { return OptionValue(shortest(value)); },
          [](const std::optional<DisparityRange>& range) {
            return range ? OptionValue(std::vector<double>{range->min, range->max}) : OptionValue();
          },
          [](const auto& value) { return OptionValue(value); }});
}

void DepthOption::set(DepthOptions& options, const OptionValue& value) const {
  const auto* words = std::get_if<std::string>(&value);
  const OptionValue meant = words ? read_words(type(), *words) : value;
  with_field(*this, options, [&](auto& place) {
    const auto before = place;
    if (!assign(place, meant))
      throw refused(std::string(name) + " is " + to_text(value) + "; it must be " +
                    what_it_must_be(type()));
    try {
      check(options);
    } catch (const Error&) {
      place = before;
      throw;
    }
  });
}

void DepthOption::check(const DepthOptions& options) const {
  with_field(*this, options,
             Overloaded{[](bool) {}, [](const std::string&) {},
                        [&](int value) { check_bounds(*this, value); },
                        [&](float value) { check_bounds(*this, value); },
                        [&](double value) { check_bounds(*this, value); },
                        [&](const std::optional<DisparityRange>& range) {
                          if (range) check_range(*this, *range);
                        },
                        [&](const std::vector<int>& indices) { check_indices(*this, indices); }});
}

std::string to_text(const OptionValue& value) {
  const auto list = [](const auto& numbers, char between) {
    std::string text;
    for (const auto number : numbers) {
      if (!text.empty()) text += between;
      text += number_text(number);
    }
    return text.empty() ? std::string("none") : text;
  };
  return std::visit(
      Overloaded{[](std::monostate) { return std::string("none"); },
                 [](bool yes) { return std::string(yes ? "true" : "false"); },
                 [](int number) { return std::to_string(number); },
                 [](double number) { return number_text(number); },
                 [&](const std::vector<int>& numbers) { return list(numbers, ','); },
                 [&](const std::vector<double>& numbers) { return list(numbers, ' '); },
                 [](const std::string& text) { return text; }},
      value);
}

}  // namespace gigaray
