// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>

#include "control_groups.h"
#include "gigaray/core/error.h"
#include "task_arena.h"

namespace gigaray {
namespace {

std::mutex stating;
std::atomic<int> stated{0};

/// What a thread does in a loop comes after all that was done before the loop began, and before all
/// that is done after it. TBB sees to that, out of sight of ThreadSanitizer; this and the mutex of
/// the loop show it.
std::atomic<unsigned> loops_begun{0};

/// Jobs in their order, for as many threads as come.
class Loop {
 public:
  Loop(int count, const std::function<void(int)>& job, const std::function<void(int)>& report)
      : count_(count), job_(job), report_(report), caller_(std::this_thread::get_id()) {
    ++loops_begun;
  }

  void work() {
    (void)loops_begun.load();
    for (int i = next_++; i < count_; i = next_++) {
      guarded([&] { job_(i); });
      {
        const std::lock_guard lock(mutex_);
        ++done_;
      }
      if (std::this_thread::get_id() == caller_) report();
    }
    const std::lock_guard lock(mutex_);
  }

  /// Reports what is not yet reported, and throws what was thrown.
  void finish() {
    report();
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  template <class Step>
  void guarded(Step step) {
    try {
      step();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      next_ = count_;
    }
  }

  void report() {
    for (;;) {
      {
        const std::lock_guard lock(mutex_);
        if (failure_ || reported_ == done_) return;
        ++reported_;
      }
      guarded([&] { report_(reported_); });
    }
  }

  const int count_;
  const std::function<void(int)>&job_, &report_;
  const std::thread::id caller_;
  std::atomic<int> next_{0};
  std::mutex mutex_;
  int done_ = 0, reported_ = 0;  // the second one is the caller's own
  std::exception_ptr failure_;
};

/// Of "200000 100000" the quotient, rounded up; 0 when there is no quota.
int processors_of(double quota, double period) {
  constexpr double kMost = 1 << 20;
  if (!(quota > 0) || !(period > 0)) return 0;
  return int(std::clamp(std::ceil(quota / period), 1.0, kMost));
}

int quota_of(const ControlGroup& group) {
  double quota = 0, period = 0;
  if (group.version == 2) {
    std::ifstream(group.folder / "cpu.max") >> quota >> period;  // "max": none
  } else {
    std::ifstream(group.folder / "cpu.cfs_quota_us") >> quota;  // -1: none
    std::ifstream(group.folder / "cpu.cfs_period_us") >> period;
  }
  return processors_of(quota, period);
}

}  // namespace

int processors_left_by_groups(const std::filesystem::path& root) {
  int least = 0;
  for (const ControlGroup& group : control_groups(root, "cpu"))
    if (const int quota = quota_of(group); quota > 0)
      least = least == 0 ? quota : std::min(least, quota);
  return least;
}

int available_processors() {
  static const int processors = [] {
    const int by_affinity = processors_of_affinity();
    const int by_groups = processors_left_by_groups("/");
    return by_groups > 0 ? std::min(by_affinity, by_groups) : by_affinity;
  }();
  return processors;
}

int num_threads() {
  const int threads = stated;
  return threads > 0 ? threads : available_processors();
}

void set_num_threads(int threads) {
  if (threads < 0)
    throw Error(ErrorCode::kInvalidArgument,
                "threads " + std::to_string(threads) + ": must be 1 or more, or 0 for all");
  const std::lock_guard lock(stating);
  limit_tbb(threads);
  stated = threads;
}

void parallel_for(int count, const std::function<void(int)>& job,
                  const std::function<void(int)>& report, int most_threads) {
  int threads = std::min(num_threads(), count);
  if (most_threads > 0) threads = std::min(threads, most_threads);
  Loop loop(count, job, report);
  if (threads <= 1)
    loop.work();
  else
    run_in_arena(
        threads, [](void* argument) { static_cast<Loop*>(argument)->work(); }, &loop);
  loop.finish();
}

}  // namespace gigaray
