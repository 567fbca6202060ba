// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "gigaray/core/run_control.h"

namespace gigaray::cli {

/// What a command does once its options are parsed. Progress and notes go through `control`, which
/// Ctrl-C cancels; results go to stdout. An Error that it throws becomes one line on stderr and the
/// exit code: kInvalidArgument 2, kCancelled 130, else 1.
using Run = std::function<void(const RunControl& control)>;

/// Declares the options of a command on `app` and returns what it does. `app` outlives the call of
/// Run, the options must too: keep them in a shared_ptr that the returned function holds.
///
///   Run hello_command(CLI::App& app) {
///     app.description("Say hello");
///     auto name = std::make_shared<std::string>();
///     app.add_option("NAME", *name, "Who")->required();
///     return [name](const RunControl&) { fmt::print("hello {}\n", *name); };
///   }
///
/// To add one: a file cli/NAME.cpp with NAME_command, its name in cli/CMakeLists.txt.
using Declare = Run (*)(CLI::App& app);

}  // namespace gigaray::cli
