// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

namespace gigaray::opencl {

// PoCL loads the compiled kernels of its cache without looking at them: a file that was cut short
// (a full disk, a crash of the machine) ends the program. So the sizes of all files are written
// down at the end of a process, and what has another size at the next start is removed and compiled
// anew.

/// Removes the programs below `folder` (PoCL's cache) with a file that is missing or whose size is
/// not the recorded one. Programs without a record are left alone: another process may be writing
/// them.
void remove_damaged_pocl_programs(const std::filesystem::path& folder);

/// Records the sizes of all files below `folder`. Does nothing when that can't be written.
void record_pocl_programs(const std::filesystem::path& folder);

}  // namespace gigaray::opencl
