// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "run.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gigaray::python {
namespace {

using namespace std::chrono_literals;

/// How often signals are looked for, and how long stopped work has to end. Together well below the
/// half second in which Ctrl-C is to be felt.
constexpr auto kLook = 40ms, kGrace = 250ms;

/// What was said, in order. Steps of one stage replace each other.
struct Report {
  bool is_message = false;
  std::string text;  ///< message or stage
  double done = 0, total = 0;
};

}  // namespace

class Job {
 public:
  Job() {
    control.on_progress = [this](const std::string& stage, double done, double total) {
      const std::lock_guard lock(mutex_);
      if (reports_.empty() || reports_.back().is_message || reports_.back().text != stage)
        reports_.emplace_back();
      reports_.back() = {false, stage, done, total};
    };
    control.on_message = [this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      reports_.push_back({true, text, 0, 0});
    };
  }

  void finish(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    is_done_ = true;
    done_.notify_all();
  }
  template <class Time>
  bool wait_for(Time time) {
    std::unique_lock lock(mutex_);
    return done_.wait_for(lock, time, [&] { return is_done_; });
  }
  void wait() {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return is_done_; });
  }
  std::deque<Report> take_reports() {
    const std::lock_guard lock(mutex_);
    return std::exchange(reports_, {});
  }
  std::exception_ptr take_failure() {
    const std::lock_guard lock(mutex_);
    return std::exchange(failure_, nullptr);
  }

  RunControl control;

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::exception_ptr failure_;
  std::deque<Report> reports_;
};

namespace {

std::mutex abandoned_mutex;
std::vector<std::shared_ptr<Job>> abandoned;

void deliver(Job& job, const py::object& progress, const py::object& message) {
  for (const Report& report : job.take_reports()) {
    if (report.is_message)
      message(report.text);
    else if (!progress.is_none())
      progress(report.text, report.done, report.total);
  }
}

/// With the interpreter's lock, which it gives free.
bool wait_a_while(Job& job, std::chrono::milliseconds time) {
  const py::gil_scoped_release free;
  return job.wait_for(time);
}

void stop(const std::shared_ptr<Job>& job) {
  job->control.cancel();
  if (wait_a_while(*job, kGrace)) return;
  const std::lock_guard lock(abandoned_mutex);
  abandoned.push_back(job);
}

}  // namespace

void run_job(std::function<void(const RunControl&)> work) {
  const py::tuple sinks = py::module_::import("gigaray._progress").attr("sinks")();
  const py::object progress = sinks[0], message = sinks[1];
  const auto job = std::make_shared<Job>();
  std::thread([job, work = std::move(work)]() mutable {
    std::exception_ptr failure;
    try {
      work(job->control);
    } catch (...) {
      failure = std::current_exception();
    }
    work = nullptr;
    job->finish(std::move(failure));
  }).detach();
  try {
    while (!wait_a_while(*job, kLook)) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      deliver(*job, progress, message);
    }
    deliver(*job, progress, message);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  } catch (py::error_already_set&) {
    stop(job);
    throw;
  }
  if (const std::exception_ptr failure = job->take_failure()) std::rethrow_exception(failure);
}

void wait_for_abandoned() {
  const py::gil_scoped_release free;
  const std::lock_guard lock(abandoned_mutex);
  for (const std::shared_ptr<Job>& job : abandoned) job->wait();
  abandoned.clear();
}

}  // namespace gigaray::python
