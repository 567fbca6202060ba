// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gigaray/adapters/atomic_output.h"

namespace gigaray::cli {

/// -o, --output and --replace.
struct OutputOption {
  std::filesystem::path path;
  bool replace = false;
  CLI::Option* option = nullptr;

  /// help: what is written there.
  CLI::Option* add_to(CLI::App& app, const std::string& help, const char* type_name = "DIR") {
    app.add_flag("--replace", replace,
                 "What is in the way and this program did not write is moved to NAME.old-1, in "
                 "place of an error");
    option =
        app.add_option("-o,--output", path, help + "; an older one of this program is replaced")
            ->type_name(type_name);
    return option;
  }
  bool is_given() const { return option != nullptr && option->count() > 0; }

  /// inputs: what the command reads; empty paths don't count.
  OutputRules rules(std::vector<std::filesystem::path> inputs) const {
    std::erase_if(inputs, [](const std::filesystem::path& input) { return input.empty(); });
    return {std::move(inputs), replace};
  }
};

}  // namespace gigaray::cli
