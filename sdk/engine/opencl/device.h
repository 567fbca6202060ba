// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <string>

#include "gigaray/device.h"
#include "opencl/errors.h"
#include "opencl/event_log.h"

namespace gigaray::opencl {

/// How the programs of a device came about.
struct ProgramCounters {
  int built = 0;   ///< Compiled from source.
  int loaded = 0;  ///< Read from the disk cache.
  int reused = 0;  ///< Found in memory.
};

enum class Profiling : bool { kOff, kOn };

/// An open device: a context, one in-order queue, and the programs built so far. Movable, not
/// copyable. One thread at a time may use a device and what was made with it; several devices, even
/// on the same hardware, may be used in parallel.
class Device {
 public:
  /// selection: see select_device(). Profiling makes log() possible and costs a little
  /// time for every command. Throws Error(kDevice).
  static Device open(const std::string& selection = "", Profiling profiling = Profiling::kOff);

  Device(Device&&) = default;
  Device& operator=(Device&&) = default;

  const DeviceInfo& info() const { return info_; }
  /// As if it had no doubles, or no 64-bit atomics: so that any device can stand for such a one.
  void hide_fp64() { info_.has_fp64 = false; }
  void hide_int64_atomics() { info_.has_int64_atomics = false; }
  const cl::Device& id() const { return id_; }
  const cl::Context& context() const { return context_; }
  const cl::CommandQueue& queue() const { return queue_; }
  /// Where commands are noted; null without profiling.
  const std::shared_ptr<EventLog>& log() const { return log_; }

  void finish() const;  ///< Waits until all commands are done.

  /// Programs by key, see program_cache.h.
  std::map<std::string, cl::Program>& programs() { return programs_; }
  ProgramCounters& counters() { return counters_; }

 private:
  Device() = default;

  DeviceInfo info_;
  cl::Device id_;
  cl::Context context_;
  cl::CommandQueue queue_;
  std::shared_ptr<EventLog> log_;
  std::map<std::string, cl::Program> programs_;
  ProgramCounters counters_;
};

}  // namespace gigaray::opencl
