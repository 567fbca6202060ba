// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/device.h"

#include <algorithm>
#include <charconv>
#include <mutex>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include "gigaray/core/arguments.h"
#include "opencl/cache_folder.h"
#include "opencl/pocl_cache.h"
#include "opencl/ready_kernels.h"
#include "opencl/text.h"

namespace gigaray::opencl {
namespace {

/// Returned by the ICD loader when no platform is installed (cl_khr_icd).
constexpr cl_int kPlatformNotFound = -1001;

struct FoundDevice {
  cl::Device device;
  DeviceInfo info;
};

/// A property of a device or platform.
template <auto kWhat, class T>
auto query(const T& object) {
  cl_int error = CL_SUCCESS;
  auto value = object.template getInfo<kWhat>(&error);
  check_cl(error, "asking a device about itself");
  if constexpr (std::is_same_v<decltype(value), std::string>)
    return std::string(trimmed(value.c_str()));  // some drivers count more than one NUL
  else
    return value;
}

bool has_extension(const std::string& extensions, const std::string& name) {
  return (" " + extensions + " ").find(" " + name + " ") != std::string::npos;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int index) {
  DeviceInfo info;
  info.index = index;
  info.name = query<CL_DEVICE_NAME>(device);
  info.vendor = query<CL_DEVICE_VENDOR>(device);
  info.platform = query<CL_PLATFORM_NAME>(platform);
  info.platform_version = query<CL_PLATFORM_VERSION>(platform);
  info.driver_version = query<CL_DRIVER_VERSION>(device);
  const cl_device_type type = query<CL_DEVICE_TYPE>(device);
  info.type = type & CL_DEVICE_TYPE_GPU   ? DeviceType::kGpu
              : type & CL_DEVICE_TYPE_CPU ? DeviceType::kCpu
                                          : DeviceType::kOther;
  info.compute_units = int(query<CL_DEVICE_MAX_COMPUTE_UNITS>(device));
  info.global_memory = query<CL_DEVICE_GLOBAL_MEM_SIZE>(device);
  info.max_allocation = query<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(device);
  info.local_memory = query<CL_DEVICE_LOCAL_MEM_SIZE>(device);
  info.max_group_size = query<CL_DEVICE_MAX_WORK_GROUP_SIZE>(device);
  info.shares_host_memory = query<CL_DEVICE_HOST_UNIFIED_MEMORY>(device);
  const std::string extensions = query<CL_DEVICE_EXTENSIONS>(device);
  info.has_int64_atomics = has_extension(extensions, "cl_khr_int64_base_atomics") &&
                           has_extension(extensions, "cl_khr_int64_extended_atomics");
  info.has_fp64 = has_extension(extensions, "cl_khr_fp64");
  return info;
}

std::vector<FoundDevice> find_devices() {
  // PoCL shows no device to a second thread while the first one initialises it.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const bool has_pocl = give_pocl_a_cache().empty();
  std::vector<cl::Platform> platforms;
  if (const cl_int error = cl::Platform::get(&platforms); error != kPlatformNotFound)
    check_cl(error, "clGetPlatformIDs");

  std::vector<FoundDevice> found;
  for (const cl::Platform& platform : platforms) {
    if (!has_pocl && query<CL_PLATFORM_NAME>(platform) == kPocl) continue;
    // A platform whose driver is broken must not hide the others.
    std::vector<cl::Device> devices;
    if (platform.getDevices(CL_DEVICE_TYPE_ALL, &devices) != CL_SUCCESS) continue;
    for (const cl::Device& device : devices) {
      if (query<CL_DEVICE_AVAILABLE>(device) && query<CL_DEVICE_COMPILER_AVAILABLE>(device))
        found.push_back({device, describe(platform, device, int(found.size()))});
    }
  }
  return found;
}

/// The first device that the selection means; end() if none.
std::vector<FoundDevice>::const_iterator match(const std::vector<FoundDevice>& found,
                                               const std::string& selection) {
  if (selection.empty()) return found.end();
  int index = 0;
  const char* end = selection.data() + selection.size();
  if (const auto [stop, error] = std::from_chars(selection.data(), end, index);
      error == std::errc() && stop == end)
    return index >= 0 && index < int(found.size()) ? found.begin() + index : found.end();

  const auto named = std::find_if(found.begin(), found.end(), [&](const FoundDevice& device) {
    return contains_ignoring_case(device.info.name, selection) ||
           contains_ignoring_case(device.info.platform, selection);
  });
  if (named != found.end()) return named;
  return std::find_if(found.begin(), found.end(), [&](const FoundDevice& device) {
    return lower_case(selection) == to_string(device.info.type);
  });
}

std::vector<FoundDevice> require_devices() {
  auto found = find_devices();
  if (const std::string& why = give_pocl_a_cache(); found.empty() && !why.empty())
    throw Error(ErrorCode::kDevice, "no OpenCL device: PoCL has no folder to compile kernels in: " +
                                        why + "; name one with " + std::to_string(kPoclRoom >> 20) +
                                        " MiB of room by GIGARAY_CACHE_DIR or TMPDIR");
  if (found.empty())
    throw Error(ErrorCode::kDevice,
                "no OpenCL device found: install pocl-opencl-icd or a GPU driver");
  return found;
}

/// What is taken when nothing is stated.
const FoundDevice& usual(const std::vector<FoundDevice>& found) {
  for (const auto type : {DeviceType::kGpu, DeviceType::kCpu}) {
    for (const auto& device : found)
      if (device.info.type == type) return device;
  }
  return found.front();
}

/// given: what the user said, of which `selection` is all, a part or the environment's in its
/// place.
const FoundDevice& select(const std::vector<FoundDevice>& found, const std::string& selection,
                          const std::string& given) {
  const auto chosen = match(found, selection);
  if (chosen != found.end()) return *chosen;
  const std::string source = given.empty() ? "GIGARAY_DEVICE" : "device";
  std::string message = source + " '" + selection + "' matches no OpenCL device; there is";
  for (const auto& device : found)
    message += (device.info.index ? ", " : " ") + std::to_string(device.info.index) + ": " +
               device.info.name;
  throw Error(ErrorCode::kDevice, message);
}

/// Each with what selects it alone.
std::vector<std::pair<FoundDevice, std::string>> select_each(const std::string& given) {
  const auto found = require_devices();
  const std::string selections = stated_device(given);
  std::vector<std::pair<FoundDevice, std::string>> chosen;
  if (selections.empty()) return {{usual(found), ""}};
  if (lower_case(selections) == "all") {
    for (const FoundDevice& device : found)
      if (device.info.type == usual(found).info.type)
        chosen.emplace_back(device, std::to_string(device.info.index));
    return chosen;
  }
  std::istringstream list(selections);
  for (std::string selection; std::getline(list, selection, ',');) {
    const FoundDevice& device = select(found, std::string(trimmed(selection)), given);
    for (const auto& [other, name] : chosen)
      if (other.info.index == device.info.index)
        throw Error(ErrorCode::kDevice, "device list '" + selections + "' names " +
                                            std::to_string(device.info.index) + ": " +
                                            device.info.name + " twice");
    chosen.emplace_back(device, trimmed(selection));
  }
  return chosen;
}

/// Of several that the environment names, the first.
FoundDevice select(const std::string& given) {
  if (given.empty()) return select_each(given).front().first;
  const auto found = require_devices();
  return select(found, given, given);
}

}  // namespace

Device::Device(std::shared_ptr<Opened> opened)
    : opened_(std::move(opened)), log_(std::make_shared<EventLog>()) {
  cl_int error = CL_SUCCESS;
  queue_ = cl::CommandQueue(context(), id(), cl_command_queue_properties(CL_QUEUE_PROFILING_ENABLE),
                            &error);
  check_cl(error, "clCreateCommandQueue on " + info().name);
}

Device Device::make(cl::Device id, DeviceInfo info, std::string selection) {
  cl_int error = CL_SUCCESS;
  cl::Context context(id, nullptr, nullptr, nullptr, &error);
  check_cl(error, "clCreateContext on " + info.name);
  auto opened = std::make_shared<Opened>();
  opened->info = std::move(info);
  opened->selection = std::move(selection);
  opened->id = std::move(id);
  opened->context = std::move(context);
  return Device(std::move(opened));
}

Device Device::open(const std::string& selection) {
  FoundDevice found = select(selection);
  return make(std::move(found.device), std::move(found.info), stated_device(selection));
}

std::vector<Device> Device::open_each(const std::string& selections) {
  std::vector<Device> devices;
  for (auto& [found, selection] : select_each(selections))
    devices.push_back(make(std::move(found.device), std::move(found.info), selection));
  return devices;
}

std::vector<std::string> selections_of(const std::string& selections) {
  std::vector<std::string> each;
  for (auto& [found, selection] : select_each(selections)) each.push_back(selection);
  return each;
}

Device Device::with_own_queue() const {
  Device other(opened_);
  other.seen_ = seen_;
  // PoCL 3.1 miscounts the users of a loaded kernel when two queues of a device run it at once, and
  // ends the process. One in-order queue for all loses nothing there: a kernel has all cores.
  if (info().platform == kPocl) other.queue_ = queue_;
  return other;
}

std::vector<Device> Device::split(int parts) const {
  GIGARAY_CHECK(parts > 0);
  const cl_device_partition_property units = info().compute_units / parts;
  const cl_device_partition_property equally[] = {CL_DEVICE_PARTITION_EQUALLY, units, 0};
  std::vector<cl::Device> found;
  const std::string what = "splitting " + info().name + " into " + std::to_string(parts);
  if (units == 0)
    throw Error(ErrorCode::kDevice,
                what + ": it has " + std::to_string(info().compute_units) + " compute units");
  check_cl(cl::Device(id()).createSubDevices(equally, &found), what);
  std::vector<Device> devices;
  for (int i = 0; i < parts; ++i) {
    DeviceInfo part = info();
    part.compute_units = int(units);
    devices.push_back(make(found.at(i), std::move(part), selection()));
  }
  return devices;
}

void Device::finish() const { GIGARAY_CL(queue_.finish()); }

ProgramCounters Device::counters() const {
  const std::lock_guard lock(programs().mutex);
  return programs().counters;
}

}  // namespace gigaray::opencl

namespace gigaray {

const char* to_string(DeviceType type) {
  switch (type) {
    case DeviceType::kCpu:
      return "cpu";
    case DeviceType::kGpu:
      return "gpu";
    case DeviceType::kOther:
      break;
  }
  return "other";
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> devices;
  for (auto& found : opencl::find_devices()) devices.push_back(std::move(found.info));
  return devices;
}

DeviceInfo select_device(const std::string& selection) { return opencl::select(selection).info; }

std::vector<DeviceInfo> select_devices(const std::string& selections) {
  std::vector<DeviceInfo> devices;
  for (auto& [found, selection] : opencl::select_each(selections))
    devices.push_back(std::move(found.info));
  return devices;
}

Device::Device(std::shared_ptr<const opencl::Device> opened) : opened_(std::move(opened)) {
  require_argument(opened_ != nullptr, "opened: is null");
}

Device Device::open(const std::string& selection) {
  return Device(std::make_shared<const opencl::Device>(opencl::Device::open(selection)));
}

std::vector<Device> Device::open_each(const std::string& selections) {
  std::vector<Device> devices;
  for (opencl::Device& opened : opencl::Device::open_each(selections))
    devices.emplace_back(std::make_shared<const opencl::Device>(std::move(opened)));
  return devices;
}

const DeviceInfo& Device::info() const { return opened_->info(); }
const std::string& Device::selection() const { return opened_->selection(); }

}  // namespace gigaray
