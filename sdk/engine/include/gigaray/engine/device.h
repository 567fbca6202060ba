// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/error.h"

namespace GIGARAY_API gigaray {
namespace opencl {
class Device;
}

enum class DeviceType { kCpu, kGpu, kOther };

const char* to_string(DeviceType type);  ///< "cpu", "gpu", "other"

/// What an OpenCL device says about itself. Sizes in bytes.
struct DeviceInfo {
  int index = 0;  ///< Position in list_devices(), counted over all platforms.
  std::string name;
  std::string vendor;
  std::string platform;
  std::string platform_version;
  std::string driver_version;
  DeviceType type = DeviceType::kOther;
  int compute_units = 0;
  std::uint64_t global_memory = 0;
  std::uint64_t max_allocation = 0;  ///< Largest single buffer.
  std::uint64_t local_memory = 0;
  std::uint64_t max_group_size = 0;
  bool shares_host_memory = false;  ///< A buffer over host memory costs no copy.
  bool has_int64_atomics = false;
  bool has_fp64 = false;
};

/// All usable OpenCL devices over all platforms; empty when there are none. Thread-safe.
///
/// The first use of OpenCL also gives PoCL a home: unless POCL_CACHE_DIR is set, its compiled
/// kernels go to the folder "gigaray-pocl" in the kernel cache, or to a temporary folder when that
/// can't be written or has no room (PoCL ends the process when it runs out of it). Without any such
/// folder the devices of PoCL are left out, and select_device() says why.
std::vector<DeviceInfo> list_devices();

/// The device that `selection` means: an index ("1"), a type ("cpu", "gpu"), or a part of a device
/// or platform name in any case ("h100"); of several the first. An empty selection takes the
/// environment variable GIGARAY_DEVICE; if that is empty too, the first GPU, else the first CPU,
/// else the first device. Throws Error(kDevice) when there is none, listing what there is.
DeviceInfo select_device(const std::string& selection = "");

/// The devices that share a run: selections with commas between them ("0,1"), each another device,
/// or "all": every device of the type that an empty selection would take. An empty list takes
/// GIGARAY_DEVICE. Throws Error(kDevice).
std::vector<DeviceInfo> select_devices(const std::string& selections = "");

/// An open OpenCL device: its context, and the kernels that were built for it, which stay until the
/// last copy is gone. Copies are cheap and are the same device. Thread-safe: any number of
/// estimators may work on a device at once, each in a command queue of its own.
class Device {
 public:
  /// selection: see select_device(). Opening again is allowed, but shares nothing. Throws
  /// Error(kDevice).
  static Device open(const std::string& selection = "");

  /// selections: see select_devices(). Throws Error(kDevice).
  static std::vector<Device> open_each(const std::string& selections = "");

  /// The engine's own way. Not null.
  explicit Device(std::shared_ptr<const opencl::Device> opened);

  const DeviceInfo& info() const;
  const std::string& selection() const;  ///< As stated; GIGARAY_DEVICE if that was empty.
  const opencl::Device& opened() const { return *opened_; }  ///< For the engine.

 private:
  std::shared_ptr<const opencl::Device> opened_;
};

/// Compiled kernels on disk. The folder is $GIGARAY_CACHE_DIR, else $XDG_CACHE_HOME/gigaray, else
/// ~/.cache/gigaray; GIGARAY_CACHE=off disables it.
struct KernelCacheInfo {
  std::string folder;  ///< Empty when the cache is off or no place for it is known.
  int programs = 0;
  std::uint64_t bytes = 0;  ///< Of the programs, and of what PoCL keeps of their kernels.
};

KernelCacheInfo kernel_cache_info();

/// Removes the compiled kernels; keeps the user's tuning. Programs in memory stay usable, but a
/// kernel of a CPU device that has never run yet would not: call it before the first use of OpenCL.
/// Throws Error(kIo) when something can't be removed, or, with nothing removed, when the kernels
/// are in use by a process with OpenCL on PoCL, be it this one.
void clear_kernel_cache();

/// Compile-time parameters of one kernel on one device.
struct KernelTuning {
  std::string kernel;
  std::map<std::string, int> parameters;  ///< e.g. LANES 16
  std::string origin;                     ///< The most specific rule in it: "user", "type cpu", …
};

/// The parameters every tunable kernel gets on this device.
std::vector<KernelTuning> tuning_in_force(const DeviceInfo& device);

}  // namespace gigaray
