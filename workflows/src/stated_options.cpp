// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/stated_options.h"

#include <fmt/format.h>

#include <variant>

#include "gigaray/adapters/options_file.h"
#include "gigaray/core/error.h"
#include "gigaray/engine/option_table.h"
#include "gigaray/workflows/did_you_mean.h"

namespace gigaray {
namespace {

Error refused(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// "; did you mean …?" for an option of the table; the last part of a name will do.
std::string about_unknown(const std::string& name) {
  std::vector<std::string> known, same_end;
  for (const DepthOption& option : depth_option_table()) {
    known.push_back(option.name);
    if (known.back().ends_with("." + name)) same_end.push_back(known.back());
  }
  return same_end.size() == 1 ? fmt::format("; did you mean {}?", same_end.front())
                              : did_you_mean(name, known);
}

}  // namespace

void set_options(const std::vector<NamedValue>& values, DepthOptions& options) {
  for (const NamedValue& value : values) {
    const DepthOption* option = find_depth_option(value.name);
    if (!option)
      throw refused(fmt::format("there is no option {}{}", value.name, about_unknown(value.name)));
    option->set(options, value.value);
  }
}

void set_option(const std::string& setting, DepthOptions& options) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos)
    throw refused(fmt::format("`set` {}: state it as NAME=VALUE", setting));
  const std::string name = setting.substr(0, equals);
  const DepthOption* option = find_depth_option(name);
  if (!option)
    throw refused(fmt::format("`set` {}: there is no such option{}", setting, about_unknown(name)));
  if (name == "preset") throw refused(fmt::format("`set` {}: `preset` states it", setting));
  option->set(options, setting.substr(equals + 1));
}

DepthOptions options_of_file(const std::filesystem::path& file, const std::string& usual_preset,
                             bool preset_is_stated) {
  const std::vector<NamedValue> values = read_options_file(file);
  const std::string where = file.string();
  std::string preset = usual_preset;
  for (const NamedValue& value : values)
    if (const auto* name = std::get_if<std::string>(&value.value); name && value.name == "preset") {
      if (preset_is_stated && *name != preset)
        throw refused(fmt::format("`preset` {}: {} states the preset {}", preset, where, *name));
      preset = *name;
    }
  try {
    DepthOptions options = preset_options(preset);
    set_options(values, options);
    return options;
  } catch (const Error& problem) {
    throw Error(ErrorCode::kBadInput, fmt::format("{}: {}", where, problem.what()));
  }
}

}  // namespace gigaray
