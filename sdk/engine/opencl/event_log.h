// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "opencl/errors.h"

namespace gigaray::opencl {

/// Seconds that a device worked, by stage, from the events of its commands. Nothing waits for it:
/// what is finished is counted when collect() is called.
class EventLog {
 public:
  /// Commands that are added from now on belong to this stage.
  void begin_stage(const std::string& stage) { stage_ = &seconds_[stage]; }
  void add(cl::Event event) {
    if (stage_) pending_.emplace_back(stage_, std::move(event));
  }
  /// All commands so far are finished.
  void collect();
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
  double* stage_ = nullptr;
  std::vector<std::pair<double*, cl::Event>> pending_;
};

}  // namespace gigaray::opencl
