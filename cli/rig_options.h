// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>

#include "gigaray/workflows/stated_rig.h"

namespace gigaray::cli {

/// --focal-px, --baseline, --focus-distance and --unit.
void add_rig_options(CLI::App& app, StatedRig& rig);

}  // namespace gigaray::cli
