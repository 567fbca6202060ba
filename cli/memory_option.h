// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "gigaray/workflows/memory_budget.h"
#include "numbers.h"

namespace gigaray::cli {

/// --memory of a command that tells from sizes alone what it will take. takes: roughly, for --help:
/// "about 40 bytes per pixel of a picture".
inline void add_memory_option(CLI::App& app, MemoryBudget& memory, const std::string& takes) {
  app.add_option("--memory", memory.gib,
                 "Most memory to use (default: three quarters of what is free); what needs more is "
                 "refused before the work. Takes " +
                     takes)
      ->check(above_zero())
      ->type_name("GiB");
}

}  // namespace gigaray::cli
