// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace gigaray {

/// Runs job(0) … job(count - 1) on all cores; report(1) … report(count) on this thread. The first
/// exception, of a job or of report, stops the rest and is thrown again.
template <class Job, class Report>
void parallel_for(int count, Job job, Report report) {
  std::mutex mutex;
  std::condition_variable changed;
  std::atomic<int> next{0};
  std::exception_ptr failure;
  int done = 0, idle = 0;
  const int num_workers = std::clamp(int(std::thread::hardware_concurrency()), 1, count);
  const auto stop_with = [&](std::exception_ptr error) {
    next = count;
    if (!failure) failure = error;
  };
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      std::exception_ptr error;
      try {
        job(i);
      } catch (...) {
        error = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      if (error) stop_with(error);
      ++done;
      changed.notify_one();
    }
    const std::lock_guard lock(mutex);
    ++idle;
    changed.notify_one();
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < num_workers; ++i) workers.emplace_back(work);
    std::unique_lock lock(mutex);
    for (int reported = 0; idle < num_workers || (reported < done && !failure);) {
      changed.wait(lock, [&] { return reported < done || idle == num_workers; });
      if (reported == done) continue;
      ++reported;
      if (failure) continue;
      lock.unlock();
      std::exception_ptr error;
      try {
        report(reported);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      if (error) stop_with(error);
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gigaray
