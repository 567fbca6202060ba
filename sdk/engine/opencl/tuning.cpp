// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/tuning.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <set>

#include "opencl/cache_folder.h"
#include "opencl/program_cache.h"
#include "opencl/text.h"

namespace gigaray::opencl {
namespace {

constexpr std::string_view kTableName = "kernel_tuning.txt";
constexpr std::string_view kScopeNames[] = {"any", "type", "vendor", "device"};

/// Cuts off and returns the text before the first `separator`, trimmed.
std::string_view take(std::string_view& rest, char separator) {
  const auto end = std::min(rest.find(separator), rest.size());
  const auto part = trimmed(rest.substr(0, end));
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

bool is_identifier(std::string_view text) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && !(text[0] >= '0' && text[0] <= '9') &&
         std::all_of(text.begin(), text.end(), is_word);
}

std::optional<TuningRule> parse_rule(std::string_view line) {
  TuningRule rule;
  std::string_view devices = take(line, '|');
  rule.kernel = take(line, '|');
  std::string_view parameters = trimmed(line);

  const auto scope = std::find(std::begin(kScopeNames), std::end(kScopeNames), take(devices, ' '));
  if (scope == std::end(kScopeNames)) return std::nullopt;
  rule.scope = TuningRule::Scope(scope - std::begin(kScopeNames));
  rule.pattern = trimmed(devices);
  if (rule.pattern.empty() != (rule.scope == TuningRule::Scope::kAny)) return std::nullopt;
  if (!is_identifier(rule.kernel)) return std::nullopt;

  while (!parameters.empty()) {
    std::string_view value = take(parameters, ' ');
    parameters = trimmed(parameters);
    const auto name = take(value, '=');
    int number = 0;
    const char* end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, number);
    if (!is_identifier(name) || error != std::errc() || stop != end) return std::nullopt;
    rule.parameters[std::string(name)] = number;
  }
  if (rule.parameters.empty()) return std::nullopt;
  return rule;
}

std::string to_line(const TuningRule& rule) {
  std::string line(kScopeNames[int(rule.scope)]);
  if (!rule.pattern.empty()) line += " " + rule.pattern;
  line += " | " + rule.kernel + " |";
  for (const auto& [name, value] : rule.parameters)
    line += " " + name + "=" + std::to_string(value);
  return line;
}

std::string origin_of(const TuningRule& rule, bool users) {
  if (users) return "user";
  const std::string scope(kScopeNames[int(rule.scope)]);
  return rule.pattern.empty() ? scope : scope + " " + rule.pattern;
}

const std::vector<TuningRule>& built_in_rules() {
  static const auto rules = parse_tuning(kernel_source(kTableName));
  return rules;
}

std::vector<TuningRule> user_rules() {
  const auto folder = cache_folder();
  const auto text = folder ? read_file(*folder / kTableName) : std::nullopt;
  return text ? parse_tuning(*text) : std::vector<TuningRule>();
}

/// Lays the matching rules over `tuning`, the general ones first.
void apply(std::vector<TuningRule> rules, const DeviceInfo& device, bool users,
           KernelTuning& tuning) {
  std::stable_sort(rules.begin(), rules.end(),
                   [](const TuningRule& a, const TuningRule& b) { return a.scope < b.scope; });
  for (const auto& rule : rules) {
    if (rule.kernel != tuning.kernel || !rule.matches(device)) continue;
    for (const auto& [name, value] : rule.parameters) tuning.parameters[name] = value;
    tuning.origin = origin_of(rule, users);
  }
}

KernelTuning tuning_of(const DeviceInfo& device, std::string_view kernel) {
  KernelTuning tuning;
  tuning.kernel = kernel;
  apply(built_in_rules(), device, false, tuning);
  apply(user_rules(), device, true, tuning);
  return tuning;
}

/// The device's name as a pattern: without what would end the field or the line.
std::string as_pattern(std::string name) {
  const auto end = name.find_first_of("|\r\n");
  return std::string(trimmed(std::string_view(name).substr(0, end)));
}

}  // namespace

bool TuningRule::matches(const DeviceInfo& device) const {
  switch (scope) {
    case Scope::kAny:
      return true;
    case Scope::kType:
      return lower_case(pattern) == to_string(device.type);
    case Scope::kVendor:
      return contains_ignoring_case(device.vendor, pattern);
    case Scope::kDevice:
      return contains_ignoring_case(device.name, pattern);
  }
  return false;
}

std::vector<TuningRule> parse_tuning(std::string_view text, std::vector<std::string>* rejected) {
  std::vector<TuningRule> rules;
  while (!text.empty()) {
    const auto line = take(text, '\n');
    if (line.empty() || line.starts_with('#')) continue;
    if (auto rule = parse_rule(line))
      rules.push_back(std::move(*rule));
    else if (rejected)
      rejected->emplace_back(line);
  }
  return rules;
}

Tuning lookup_tuning(const DeviceInfo& device, std::string_view kernel) {
  return tuning_of(device, kernel).parameters;
}

std::string defines(const Tuning& tuning) {
  std::string options;
  for (const auto& [name, value] : tuning)
    options += (options.empty() ? "-D" : " -D") + name + "=" + std::to_string(value);
  return options;
}

void save_user_tuning(const DeviceInfo& device, std::string_view kernel, const Tuning& tuning) {
  const TuningRule result{TuningRule::Scope::kDevice, as_pattern(device.name), std::string(kernel),
                          tuning};
  GIGARAY_CHECK(parse_rule(to_line(result)).has_value());
  const auto folder = cache_folder();
  if (!folder)
    throw Error(ErrorCode::kIo,
                "tuning can't be stored: the kernel cache is off; unset GIGARAY_CACHE or set "
                "GIGARAY_CACHE_DIR to a folder");
  std::string text = "# Results of `gigaray devices --tune`.\n";
  for (const auto& rule : user_rules()) {
    const bool replaced = rule.scope == result.scope && rule.pattern == result.pattern &&
                          rule.kernel == result.kernel;
    if (!replaced) text += to_line(rule) + "\n";
  }
  text += to_line(result) + "\n";
  if (!write_file_atomically(*folder / kTableName, text))
    throw Error(ErrorCode::kIo, "tuning can't be stored in " + folder->string() +
                                    "; set GIGARAY_CACHE_DIR to a folder that can be written");
}

}  // namespace gigaray::opencl

namespace gigaray {

std::vector<KernelTuning> tuning_in_force(const DeviceInfo& device) {
  std::set<std::string> kernels;
  for (const auto& rule : opencl::built_in_rules()) kernels.insert(rule.kernel);
  std::vector<KernelTuning> tunings;
  for (const auto& kernel : kernels) tunings.push_back(opencl::tuning_of(device, kernel));
  return tunings;
}

}  // namespace gigaray
