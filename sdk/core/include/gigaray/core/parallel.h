// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <functional>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// Processors that this process may use, 1 or more: those of its affinity mask (`taskset`), less
/// what the quotas of its control groups allow (`docker run --cpus`), rounded up. The same at every
/// call.
int available_processors();

/// Processors that the quotas of the control groups allow, rounded up, by the files of /proc and
/// /sys under `root`; 0 when they say nothing.
int processors_left_by_groups(const std::filesystem::path& root);

/// Threads that the loops of this process run on, the calling one included: as stated, else
/// available_processors(). No result depends on it.
int num_threads();

/// States that number, 1 or more; 0: available_processors() again. Anything else throws
/// Error(kInvalidArgument). Holds for the loops that begin later.
void set_num_threads(int threads);

/// Runs job(0) … job(count - 1), begun in this order, on num_threads() threads, of which this is
/// one, and on `most_threads` of them at most unless that is 0. report(1) … report(count) are
/// called on this thread, between its own jobs and at the end. The first exception, of a job or of
/// report, stops the rest and is thrown again. Loops inside jobs share the threads.
void parallel_for(int count, const std::function<void(int)>& job,
                  const std::function<void(int)>& report, int most_threads = 0);

}  // namespace gigaray
