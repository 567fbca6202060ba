// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

namespace gigaray {

/// Calls work(argument) on up to so many threads at once, `threads` times in all, of which this
/// thread is one; returns when all are done. work must not throw.
void run_in_arena(int threads, void (*work)(void*), void* argument);

/// Processors of the affinity mask, 1 or more.
int processors_of_affinity();

/// What else runs on TBB, OpenCV among it, keeps to the number too. 0: no limit.
void limit_tbb(int threads);

}  // namespace gigaray
