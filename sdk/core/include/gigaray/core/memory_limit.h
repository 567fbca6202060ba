// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// Bytes that this process may still take: the least of what the machine (/proc/meminfo), its
/// control groups of version 1 or 2 with all those around them, and its own limits of address space
/// and data (`ulimit -v`, `-d`) leave. Cached files count as free: the system gives them back.
/// Read anew at each call; what isn't there or can't be understood limits nothing.
double available_memory();

/// The limit of a run that states none: three quarters of available_memory().
double default_memory_limit();

/// Bytes that the machine and the control groups leave, by the files of /proc and /sys under
/// `root`; infinity when they say nothing.
double memory_left_by_system(const std::filesystem::path& root);

/// Bytes that RLIMIT_AS and RLIMIT_DATA leave, less what is mapped by `root`/proc/self/statm
/// and, of address space, what libraries loaded later map without using it;
/// infinity without limits.
double memory_left_by_limits(const std::filesystem::path& root);

}  // namespace gigaray
