// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/baselines/baseline.h"

namespace gigaray::baselines {

/// A program for pairs of pictures, described by a JSON file (docs/formats.md):
///
///   {"name": "elas", "title": "ELAS", "reference": "Geiger et al. 2010",
///    "parameters": "defaults", "command": ["elas", "{left}", "{right}", "{disparity}"],
///    "pictures": "pgm", "disparity": "pfm", "scale": 1}
///
/// The command runs without a shell; {left}, {right} and {disparity} become
/// names of files, {min} and {max} the whole disparities to search. What the left picture shows at
/// u the right one shows at u − d; the map holds d / scale, not finite where there is none. Throws
/// Error(kBadInput) naming the file and what is wrong with it, Error(kIo) when the program is not
/// there. A trial throws Error(kIo) when it fails, with the last line that it printed,
/// Error(kBadInput) when its map has another size.
Baseline external_baseline(const std::filesystem::path& description);

}  // namespace gigaray::baselines
