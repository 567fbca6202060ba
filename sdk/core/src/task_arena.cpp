// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// All that is compiled of oneTBB. Without ThreadSanitizer (CMakeLists.txt): it does not see how the
// library orders its own accesses.
#include "task_arena.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>

namespace gigaray {

namespace tbb = oneapi::tbb;

void run_in_arena(int threads, void (*work)(void*), void* argument) {
  // An arena of its own: a thread that waits here takes no job of a loop around this one, which
  // could need what it holds.
  tbb::task_arena arena(threads);
  arena.execute([=] {
    tbb::parallel_for(
        0, threads, [=](int) { work(argument); }, tbb::simple_partitioner());
  });
}

int processors_of_affinity() { return std::max(tbb::info::default_concurrency(), 1); }

void limit_tbb(int threads) {
  static std::unique_ptr<tbb::global_control> limit;
  limit.reset();
  if (threads > 0)
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  std::size_t(threads));
}

}  // namespace gigaray
