// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// Another program with what it prints, stdout and stderr together. It runs in a process group of
/// its own, which is killed when this object goes, and also when this process ends in any other
/// way.
class ChildProcess {
 public:
  /// Starts arguments[0], looked for on PATH, without a shell. settings: NAME=VALUE, added to the
  /// environment unless NAME is set there. Throws Error(kIo) when it can't be started; is_missing()
  /// tells before whether it is installed.
  ChildProcess(const std::vector<std::string>& arguments, const std::vector<std::string>& settings);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// What it has printed since the last call; waits for at most so long. Empty string: nothing
  /// yet. No value: it closed its output.
  std::optional<std::string> read(std::chrono::milliseconds wait);

  /// Waits for its end: "" when it succeeded, else "ended with status 3" or "was killed by signal
  /// 9". Call it after read() gave no value.
  std::string result();

 private:
  void close_output();

  pid_t pid_ = -1;
  int output_ = -1;
  int alive_ = -1;  ///< open as long as this process lives
};

/// Is there no such program on PATH?
bool is_missing(const std::string& program);

}  // namespace gigaray
