// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/engine/device.h"
#include "opencl/errors.h"
#include "opencl/event_log.h"

namespace gigaray::opencl {

/// The name of PoCL's platform.
inline constexpr const char* kPocl = "Portable Computing Language";

/// How the programs of a device came about.
struct ProgramCounters {
  int built = 0;   ///< From source. PoCL compiles what is not in its own cache.
  int loaded = 0;  ///< Read from the cache of programs.
  int reused = 0;  ///< Found in memory.
};

/// What build_program() keeps of a device.
struct Programs {
  std::mutex mutex;  ///< of all that follows
  std::map<std::string, cl::Program> by_key;
  ProgramCounters counters;
};

/// An open device, seen through one in-order queue. Copies are cheap: they share context, programs
/// and queue. One thread at a time may use a queue and what was made with it; with_own_queue() is
/// for another thread, and so is a device opened again. build_program() is thread-safe.
class Device {
 public:
  /// selection: see select_device(). Throws Error(kDevice).
  static Device open(const std::string& selection = "");
  /// selections: see select_devices(). Throws Error(kDevice).
  static std::vector<Device> open_each(const std::string& selections = "");

  /// The same context and programs with a queue (on PoCL the same one) and a log of its own.
  /// Thread-safe.
  Device with_own_queue() const;

  /// Devices with as many compute units each, in their own contexts: several devices for tests,
  /// where there is one CPU. Throws Error(kDevice) where there are too few units, or the driver
  /// can't do it.
  std::vector<Device> split(int parts) const;

  bool is_pocl() const { return info().platform == kPocl; }
  const DeviceInfo& info() const { return seen_ ? *seen_ : opened_->info; }
  /// As if it had no doubles, or no 64-bit atomics: so that any device can stand for such a one.
  void hide_fp64() { hide().has_fp64 = false; }
  void hide_int64_atomics() { hide().has_int64_atomics = false; }
  void hide_shared_memory() { hide().shares_host_memory = false; }
  /// As if it were another driver, without a cache of its own.
  void hide_pocl() { hide().platform = "not PoCL"; }
  void hide_local_memory(std::size_t but_bytes) { hide().local_memory = but_bytes; }
  /// What was given to open(), or GIGARAY_DEVICE if that was empty.
  const std::string& selection() const { return opened_->selection; }
  const cl::Device& id() const { return opened_->id; }
  const cl::Context& context() const { return opened_->context; }
  const cl::CommandQueue& queue() const { return queue_; }
  /// Where the kernels of this queue are noted.
  const std::shared_ptr<EventLog>& log() const { return log_; }

  void finish() const;  ///< Waits until all commands of the queue are done.

  Programs& programs() const { return opened_->programs; }
  ProgramCounters counters() const;  ///< of all queues; thread-safe

 private:
  struct Opened {
    DeviceInfo info;
    std::string selection;
    cl::Device id;
    cl::Context context;
    Programs programs;
  };
  explicit Device(std::shared_ptr<Opened> opened);
  static Device make(cl::Device id, DeviceInfo info, std::string selection);

  DeviceInfo& hide() {
    if (!seen_) seen_ = opened_->info;
    return *seen_;
  }

  std::shared_ptr<Opened> opened_;
  std::optional<DeviceInfo> seen_;  ///< less than it has
  cl::CommandQueue queue_;
  std::shared_ptr<EventLog> log_;
};

/// What selects each of the devices that `selections` means, see select_devices(), alone. Throws
/// Error(kDevice).
std::vector<std::string> selections_of(const std::string& selections);

}  // namespace gigaray::opencl
