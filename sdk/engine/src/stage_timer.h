// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace gigaray {

/// Adds the seconds of its lifetime to a stage.
class StageTimer {
 public:
  StageTimer(std::map<std::string, double>& seconds, const std::string& stage)
      : sum_(seconds[stage]), begin_(std::chrono::steady_clock::now()) {}
  ~StageTimer() {
    sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace gigaray
