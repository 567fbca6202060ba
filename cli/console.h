// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "gigaray/core/run_control.h"

namespace gigaray::cli {

/// Shows the progress and the notes of a run on stderr: a bar with rate and remaining time when
/// stderr is a terminal, else one plain line per stage. Ctrl-C, SIGTERM, SIGHUP (unless it is
/// ignored, as under nohup), SIGXCPU and a SIGPIPE of somebody else cancel the run; a second one
/// kills the program. A pipe that nobody reads any more and a file that may not grow are errors of
/// writing, no signals. One at a time; it stays in force until the program ends.
class Console {
 public:
  explicit Console(RunControl& control);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// The signal that cancelled the run; 0: none.
  static int signal_received();

 private:
  using Clock = std::chrono::steady_clock;

  void show_progress(const std::string& stage, double done, double total);
  void show_message(const std::string& text);
  void clear_bar();

  const bool is_terminal_;
  std::mutex mutex_;
  std::string stage_;
  Clock::time_point stage_start_;
  Clock::time_point last_drawn_;
  bool bar_visible_ = false;
};

}  // namespace gigaray::cli
