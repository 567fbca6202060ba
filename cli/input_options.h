// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "gigaray/workflows/input.h"

namespace gigaray::cli {

/// INPUT and the options that say how to read it; shared by the commands that take a light field.
struct InputOptions : InputRequest {
  InputOptions() { keep_pictures = false; }

  void add_to(CLI::App& app);
};

}  // namespace gigaray::cli
