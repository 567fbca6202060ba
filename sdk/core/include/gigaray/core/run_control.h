// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/error.h"

namespace GIGARAY_API gigaray {

/// Handle that every long call takes: it reports progress and can be asked to stop. The library
/// itself prints nothing.
class RunControl {
 public:
  /// stage: what is done now, e.g. "level 0"; done of total in the same, arbitrary unit.
  using ProgressSink = std::function<void(const std::string& stage, double done, double total)>;
  using MessageSink = std::function<void(const std::string& message)>;

  RunControl() = default;
  /// A part of another run, which must outlive it: it stops when that is asked to, reports its
  /// stages as "`name`, stage" (those of parts of its own as they come), and has nothing to say.
  RunControl(const RunControl& whole, const std::string& name)
      : on_progress([&whole, name](const std::string& stage, double done, double total) {
          const bool is_of_part = stage.find(", ") != std::string::npos;
          whole.progress(is_of_part ? stage : name + ", " + stage, done, total);
        }),
        whole_(&whole) {}

  ProgressSink on_progress;
  MessageSink on_message;  ///< Notes for the user: what was assumed, chosen or left out.

  /// Asks the running call to stop soon. Safe in a signal handler and from any thread.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const {
    const bool asked =
        cancelled_.load(std::memory_order_relaxed) || (whole_ && whole_->cancelled());
    return asked && !kept_.load(std::memory_order_relaxed);
  }

  /// Throws Error(kCancelled) when cancel() was called. Long loops call it often.
  void throw_if_cancelled() const {
    if (cancelled()) throw Error(ErrorCode::kCancelled, "stopped before the end; nothing was kept");
  }
  /// What `call` returns. What it throws after cancel() becomes the stop that was asked for: a part
  /// that watches for the same signal may fail over it, as PoCL's compiler does, which then throws
  /// away its files.
  template <class Call>
  auto stop_or_fail(const Call& call) const {
    try {
      return call();
    } catch (...) {
      throw_if_cancelled();
      throw;
    }
  }
  /// The last moment to stop: throws when cancel() was called; after it cancel() is without effect,
  /// since a result is being put in its place and "nothing was kept" would be wrong.
  void keep_result() const {
    throw_if_cancelled();
    kept_.store(true, std::memory_order_relaxed);
  }
  /// Was a result put in its place?
  bool has_kept() const { return kept_.load(std::memory_order_relaxed); }
  void progress(const std::string& stage, double done, double total) const {
    throw_if_cancelled();
    if (on_progress) on_progress(stage, done, total);
  }
  void message(const std::string& text) const {
    if (on_message) on_message(text);
  }

 private:
  const RunControl* whole_ = nullptr;
  std::atomic<bool> cancelled_{false};
  mutable std::atomic<bool> kept_{false};
};

}  // namespace gigaray
