// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

namespace gigaray {

/// Bytes that this process may still take: the least of what the machine, its control groups and
/// its own resource limits leave. Read anew at each call.
double available_memory();

/// The limit of a run that states none: three quarters of available_memory().
double default_memory_limit();

}  // namespace gigaray
