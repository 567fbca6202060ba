// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace gigaray::cli {

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string all = fmt::format("{{{}}}", fmt::join(words, ","));
  return CLI::Validator(
      [words = std::move(words)](const std::string& text) {
        if (std::ranges::find(words, text) != words.end()) return std::string();
        if (words.size() == 1) return fmt::format("is '{}'; it must be {}", text, words.front());
        return fmt::format("is '{}'; it must be {} or {}{}", text,
                           fmt::join(words.begin(), words.end() - 1, ", "), words.back(),
                           did_you_mean(text, words));
      },
      all);
}

std::string about_unknown_option(const CLI::App& command) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& name : option->get_snames()) known.push_back("-" + name);
  }
  for (const std::string& argument : command.remaining()) {
    const std::string name = argument.substr(0, argument.find('='));
    const bool is_option = name.size() > 1 && name[0] == '-' && name != "--" &&
                           std::isalpha(static_cast<unsigned char>(name[name[1] == '-' ? 2 : 1]));
    if (!is_option || std::ranges::find(known, name) != known.end()) continue;
    return fmt::format("there is no option {}{}", name, did_you_mean(name, known));
  }
  return {};
}

}  // namespace gigaray::cli
