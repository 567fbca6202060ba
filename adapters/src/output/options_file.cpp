// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Options of a run as JSON: their record in a gigaray.json, and files that state some of them.
#include "gigaray/adapters/options_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <type_traits>
#include <variant>

#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

using nlohmann::ordered_json;

constexpr auto kReplace = ordered_json::error_handler_t::replace;

ordered_json json_of(const OptionValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return nullptr;
  if (const double* number = std::get_if<double>(&value); number && !std::isfinite(*number))
    return std::isnan(*number) ? "nan" : *number > 0 ? "inf" : "-inf";
  return std::visit(
      [](const auto& plain) {
        if constexpr (std::is_same_v<std::decay_t<decltype(plain)>, std::monostate>)
          return ordered_json(nullptr);
        else
          return ordered_json(plain);
      },
      value);
}

bool is_int(const ordered_json& entry) {
  if (!entry.is_number_integer()) return false;
  if (entry.is_number_unsigned() &&
      entry.get<std::uint64_t>() > std::uint64_t(std::numeric_limits<int>::max()))
    return false;
  const auto number = entry.get<std::int64_t>();
  return number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max();
}

/// Empty: no value that an option could have.
std::optional<OptionValue> value_of(const ordered_json& entry) {
  if (entry.is_null()) return OptionValue();
  if (entry.is_boolean()) return entry.get<bool>();
  if (is_int(entry)) return entry.get<int>();
  if (entry.is_number()) return entry.get<double>();
  if (entry.is_string()) return entry.get<std::string>();
  if (!entry.is_array()) return std::nullopt;
  if (!std::ranges::all_of(entry, [](const auto& number) { return number.is_number(); }))
    return std::nullopt;
  if (std::ranges::all_of(entry, is_int)) return entry.get<std::vector<int>>();
  return entry.get<std::vector<double>>();
}

void flatten(const ordered_json& object, const std::string& prefix, const std::string& where,
             std::vector<NamedValue>& values) {
  for (const auto& [key, entry] : object.items()) {
    const std::string name = prefix + key;
    if (entry.is_object()) {
      flatten(entry, name + ".", where, values);
      continue;
    }
    const auto value = value_of(entry);
    if (!value)
      throw Error(ErrorCode::kBadInput,
                  where + ": " + name + " is " + entry.dump(-1, ' ', true, kReplace).substr(0, 60) +
                      "; it must be true, false, a number, a list of numbers, a text or null");
    values.push_back({name, *value});
  }
}

}  // namespace

std::string options_json(const std::vector<NamedValue>& values) {
  ordered_json root = ordered_json::object();
  for (const NamedValue& option : values) {
    ordered_json* place = &root;
    std::string_view name = option.name;
    for (auto dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.')) {
      place = &(*place)[std::string(name.substr(0, dot))];
      name.remove_prefix(dot + 1);
    }
    (*place)[std::string(name)] = json_of(option.value);
  }
  return root.dump(2, ' ', false, kReplace);
}

std::vector<NamedValue> parse_options_json(std::string_view text, const std::string& where) {
  const ordered_json root = ordered_json::parse(text, nullptr, false);
  if (!root.is_object())
    throw Error(ErrorCode::kBadInput, where + ": is damaged or no JSON object");
  const ordered_json* options = &root;
  if (const auto format = root.find("format"); format != root.end()) {
    if (*format != kDepthFormat)
      throw Error(ErrorCode::kBadInput,
                  where + ": is neither a list of options nor a result of `gigaray depth`");
    const auto asked = root.find("options_asked");
    if (asked == root.end() || !asked->is_object())
      throw Error(ErrorCode::kBadInput,
                  where +
                      ": has no options_asked; a version that did not record all options "
                      "wrote it");
    options = &*asked;
  }
  std::vector<NamedValue> values;
  flatten(*options, "", where, values);
  return values;
}

std::vector<NamedValue> read_options_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto file = std::filesystem::is_directory(path, ignored) ? path / "gigaray.json" : path;
  return parse_options_json(read_json_text(file), file.string());
}

}  // namespace gigaray
