// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>

namespace gigaray::cli {

/// --threads of a command that has --memory; nothing for the others.
void add_threads_option(CLI::App& app);

/// Makes OpenCL on processors keep to num_threads(), where PoCL is what runs it. Before the first
/// call of OpenCL.
void limit_opencl_threads();

}  // namespace gigaray::cli
