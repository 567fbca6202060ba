// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/run_control.h"
#include "input_options.h"

namespace gigaray::cli {

/// Opens an input. When it is a folder of photographs from anywhere, that is, pictures that form no
/// row, their cameras are found with COLMAP first. What COLMAP makes stays in OUTPUT.colmap, a
/// folder beside the output, and serves the next run with the same photographs.
LightField open_or_find_cameras(InputOptions input, const std::filesystem::path& output,
                                const RunControl& control);

}  // namespace gigaray::cli
