// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/adapters/colmap_program.h"
#include "gigaray/run_control.h"
#include "input_options.h"
#include "output_option.h"

namespace gigaray::cli {

/// Finds the cameras of a folder of photographs with COLMAP and returns the workspace
/// OUTPUT.colmap, a folder beside the output. One of an earlier run with the same photographs and
/// options is taken as it is; another is replaced like an output. Throws as run_colmap and
/// AtomicFolder do; of a run that fails the log is kept.
std::filesystem::path find_cameras(const std::filesystem::path& photographs,
                                   const ColmapRunOptions& options, const OutputOption& output,
                                   const RunControl& control);

/// Opens an input for the commands that don't find cameras: photographs from anywhere are an error
/// that says what does, by the same rule as open_or_find_cameras.
LightField open_views(InputOptions input, const RunControl& control);

/// Opens an input. When it is a folder of photographs from anywhere, that is, pictures that form no
/// row, find_cameras() comes first.
LightField open_or_find_cameras(InputOptions input, const OutputOption& output,
                                const RunControl& control);

}  // namespace gigaray::cli
