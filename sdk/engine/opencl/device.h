// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <map>
#include <string>
#include <utility>

#include "gigaray/device.h"

namespace gigaray::opencl {

/// "CL_OUT_OF_RESOURCES (-5)"
std::string error_name(cl_int error);

/// Throws unless `error` is CL_SUCCESS: Error(kOutOfMemory) when an allocation failed, else
/// Error(kDevice), with `what` (the text of the call, or a sentence) and the error's name.
void check_cl(cl_int error, const std::string& what);

/// GIGARAY_CL(clFinish(queue)); throws with the text of the call when it fails.
#define GIGARAY_CL(call)                                                        \
  do {                                                                          \
    if (const cl_int gigaray_cl_error = (call); gigaray_cl_error != CL_SUCCESS) \
      ::gigaray::opencl::check_cl(gigaray_cl_error, #call);                     \
  } while (false)

/// Shared ownership of an OpenCL object by its own reference count.
template <class T, auto Retain, auto Release>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T object) : object_(object) {}  ///< Takes over the reference.
  Handle(const Handle& other) : object_(other.object_) {
    if (object_) Retain(object_);
  }
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_) Release(object_);
  }
  T get() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  T object_ = nullptr;
};

using Context = Handle<cl_context, clRetainContext, clReleaseContext>;
using Queue = Handle<cl_command_queue, clRetainCommandQueue, clReleaseCommandQueue>;
using Program = Handle<cl_program, clRetainProgram, clReleaseProgram>;

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
  /// selection: see select_device(). Profiling makes Kernel::run_timed() possible and costs a
  /// little time for every command. Throws Error(kDevice).
  static Device open(const std::string& selection = "", Profiling profiling = Profiling::kOff);

  Device(Device&&) = default;
  Device& operator=(Device&&) = default;

  const DeviceInfo& info() const { return info_; }
  cl_device_id id() const { return id_; }
  const Context& context() const { return context_; }
  const Queue& queue() const { return queue_; }
  bool profiling() const { return profiling_; }

  void finish() const;  ///< Waits until all commands are done.

  /// Programs by key, see program_cache.h.
  std::map<std::string, Program>& programs() { return programs_; }
  ProgramCounters& counters() { return counters_; }

 private:
  Device() = default;

  DeviceInfo info_;
  cl_device_id id_ = nullptr;
  bool profiling_ = false;
  Context context_;
  Queue queue_;
  std::map<std::string, Program> programs_;
  ProgramCounters counters_;
};

}  // namespace gigaray::opencl
