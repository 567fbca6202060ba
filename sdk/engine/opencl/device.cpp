// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/device.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "opencl/cache_folder.h"
#include "opencl/pocl_cache.h"
#include "opencl/text.h"

namespace gigaray::opencl {
namespace {

/// Returned by the ICD loader when no platform is installed (cl_khr_icd).
constexpr cl_int kPlatformNotFound = -1001;
constexpr const char* kPocl = "Portable Computing Language";

struct FoundDevice {
  cl_device_id id;
  DeviceInfo info;
};

template <class T>
T query(cl_device_id device, cl_device_info what) {
  T value{};
  check_cl(clGetDeviceInfo(device, what, sizeof value, &value, nullptr), "clGetDeviceInfo");
  return value;
}

std::string trimmed_c_string(std::string text) {
  return std::string(trimmed(std::string_view(text).substr(0, text.find('\0'))));
}

std::string query_text(cl_device_id device, cl_device_info what) {
  std::size_t size = 0;
  check_cl(clGetDeviceInfo(device, what, 0, nullptr, &size), "clGetDeviceInfo");
  std::string text(size, '\0');
  check_cl(clGetDeviceInfo(device, what, size, text.data(), nullptr), "clGetDeviceInfo");
  return trimmed_c_string(std::move(text));
}

std::string query_text(cl_platform_id platform, cl_platform_info what) {
  std::size_t size = 0;
  check_cl(clGetPlatformInfo(platform, what, 0, nullptr, &size), "clGetPlatformInfo");
  std::string text(size, '\0');
  check_cl(clGetPlatformInfo(platform, what, size, text.data(), nullptr), "clGetPlatformInfo");
  return trimmed_c_string(std::move(text));
}

bool has_extension(const std::string& extensions, const std::string& name) {
  return (" " + extensions + " ").find(" " + name + " ") != std::string::npos;
}

DeviceInfo describe(cl_platform_id platform, cl_device_id device, int index) {
  DeviceInfo info;
  info.index = index;
  info.name = query_text(device, CL_DEVICE_NAME);
  info.vendor = query_text(device, CL_DEVICE_VENDOR);
  info.platform = query_text(platform, CL_PLATFORM_NAME);
  info.platform_version = query_text(platform, CL_PLATFORM_VERSION);
  info.driver_version = query_text(device, CL_DRIVER_VERSION);
  const auto type = query<cl_device_type>(device, CL_DEVICE_TYPE);
  info.type = type & CL_DEVICE_TYPE_GPU   ? DeviceType::kGpu
              : type & CL_DEVICE_TYPE_CPU ? DeviceType::kCpu
                                          : DeviceType::kOther;
  info.compute_units = int(query<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS));
  info.global_memory = query<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE);
  info.max_allocation = query<cl_ulong>(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  info.local_memory = query<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE);
  info.max_group_size = query<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE);
  info.shares_host_memory = query<cl_bool>(device, CL_DEVICE_HOST_UNIFIED_MEMORY);
  const std::string extensions = query_text(device, CL_DEVICE_EXTENSIONS);
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
  cl_uint num_platforms = 0;
  const cl_int error = clGetPlatformIDs(0, nullptr, &num_platforms);
  if (error == kPlatformNotFound || num_platforms == 0) return {};
  check_cl(error, "clGetPlatformIDs");
  std::vector<cl_platform_id> platforms(num_platforms);
  GIGARAY_CL(clGetPlatformIDs(num_platforms, platforms.data(), nullptr));

  std::vector<FoundDevice> found;
  for (const auto platform : platforms) {
    if (!has_pocl && query_text(platform, CL_PLATFORM_NAME) == kPocl) continue;
    // A platform whose driver is broken must not hide the others.
    cl_uint num_devices = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &num_devices) != CL_SUCCESS)
      continue;
    std::vector<cl_device_id> devices(num_devices);
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, num_devices, devices.data(), nullptr) !=
        CL_SUCCESS)
      continue;
    for (const auto device : devices) {
      if (query<cl_bool>(device, CL_DEVICE_AVAILABLE) &&
          query<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE))
        found.push_back({device, describe(platform, device, int(found.size()))});
    }
  }
  return found;
}

/// The first device that the selection means; end() if none.
std::vector<FoundDevice>::const_iterator match(const std::vector<FoundDevice>& found,
                                               const std::string& selection) {
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

FoundDevice select(const std::string& given) {
  const auto found = find_devices();
  if (const std::string& why = give_pocl_a_cache(); found.empty() && !why.empty())
    throw Error(ErrorCode::kDevice, "no OpenCL device: PoCL has no folder to compile kernels in: " +
                                        why + "; name one with " + std::to_string(kPoclRoom >> 20) +
                                        " MiB of room by GIGARAY_CACHE_DIR or TMPDIR");
  if (found.empty())
    throw Error(ErrorCode::kDevice,
                "no OpenCL device found: install pocl-opencl-icd or a GPU driver");
  std::string selection = given;
  std::string source = "device";
  if (selection.empty()) {
    const char* fallback = std::getenv("GIGARAY_DEVICE");
    if (fallback) selection = fallback;
    source = "GIGARAY_DEVICE";
  }
  if (selection.empty()) {
    for (const auto type : {DeviceType::kGpu, DeviceType::kCpu}) {
      for (const auto& device : found)
        if (device.info.type == type) return device;
    }
    return found.front();
  }
  const auto chosen = match(found, selection);
  if (chosen != found.end()) return *chosen;
  std::string message = source + " '" + selection + "' matches no OpenCL device; there is";
  for (const auto& device : found)
    message += (device.info.index ? ", " : " ") + std::to_string(device.info.index) + ": " +
               device.info.name;
  throw Error(ErrorCode::kDevice, message);
}

}  // namespace

std::string error_name(cl_int error) {
#define GIGARAY_NAME(code) \
  case code:               \
    return #code " (" + std::to_string(code) + ")";
  switch (error) {
    GIGARAY_NAME(CL_SUCCESS)
    GIGARAY_NAME(CL_DEVICE_NOT_FOUND)
    GIGARAY_NAME(CL_DEVICE_NOT_AVAILABLE)
    GIGARAY_NAME(CL_COMPILER_NOT_AVAILABLE)
    GIGARAY_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE)
    GIGARAY_NAME(CL_OUT_OF_RESOURCES)
    GIGARAY_NAME(CL_OUT_OF_HOST_MEMORY)
    GIGARAY_NAME(CL_PROFILING_INFO_NOT_AVAILABLE)
    GIGARAY_NAME(CL_MEM_COPY_OVERLAP)
    GIGARAY_NAME(CL_BUILD_PROGRAM_FAILURE)
    GIGARAY_NAME(CL_MAP_FAILURE)
    GIGARAY_NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET)
    GIGARAY_NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST)
    GIGARAY_NAME(CL_INVALID_VALUE)
    GIGARAY_NAME(CL_INVALID_DEVICE_TYPE)
    GIGARAY_NAME(CL_INVALID_PLATFORM)
    GIGARAY_NAME(CL_INVALID_DEVICE)
    GIGARAY_NAME(CL_INVALID_CONTEXT)
    GIGARAY_NAME(CL_INVALID_QUEUE_PROPERTIES)
    GIGARAY_NAME(CL_INVALID_COMMAND_QUEUE)
    GIGARAY_NAME(CL_INVALID_HOST_PTR)
    GIGARAY_NAME(CL_INVALID_MEM_OBJECT)
    GIGARAY_NAME(CL_INVALID_BINARY)
    GIGARAY_NAME(CL_INVALID_BUILD_OPTIONS)
    GIGARAY_NAME(CL_INVALID_PROGRAM)
    GIGARAY_NAME(CL_INVALID_PROGRAM_EXECUTABLE)
    GIGARAY_NAME(CL_INVALID_KERNEL_NAME)
    GIGARAY_NAME(CL_INVALID_KERNEL_DEFINITION)
    GIGARAY_NAME(CL_INVALID_KERNEL)
    GIGARAY_NAME(CL_INVALID_ARG_INDEX)
    GIGARAY_NAME(CL_INVALID_ARG_VALUE)
    GIGARAY_NAME(CL_INVALID_ARG_SIZE)
    GIGARAY_NAME(CL_INVALID_KERNEL_ARGS)
    GIGARAY_NAME(CL_INVALID_WORK_DIMENSION)
    GIGARAY_NAME(CL_INVALID_WORK_GROUP_SIZE)
    GIGARAY_NAME(CL_INVALID_WORK_ITEM_SIZE)
    GIGARAY_NAME(CL_INVALID_GLOBAL_OFFSET)
    GIGARAY_NAME(CL_INVALID_EVENT_WAIT_LIST)
    GIGARAY_NAME(CL_INVALID_EVENT)
    GIGARAY_NAME(CL_INVALID_OPERATION)
    GIGARAY_NAME(CL_INVALID_BUFFER_SIZE)
    GIGARAY_NAME(CL_INVALID_GLOBAL_WORK_SIZE)
    default:
      return "error " + std::to_string(error);
  }
#undef GIGARAY_NAME
}

void check_cl(cl_int error, const std::string& what) {
  if (error == CL_SUCCESS) return;
  const bool memory = error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_HOST_MEMORY;
  throw Error(memory ? ErrorCode::kOutOfMemory : ErrorCode::kDevice,
              "OpenCL: " + what + " failed with " + error_name(error));
}

Device Device::open(const std::string& selection, Profiling profiling) {
  auto [id, info] = select(selection);
  Device device;
  device.info_ = std::move(info);
  device.id_ = id;
  device.profiling_ = profiling == Profiling::kOn;
  if (device.profiling_) device.log_ = std::make_shared<EventLog>();
  cl_int error = CL_SUCCESS;
  device.context_ = Context(clCreateContext(nullptr, 1, &id, nullptr, nullptr, &error));
  check_cl(error, "clCreateContext on " + device.info_.name);
  device.queue_ = Queue(clCreateCommandQueue(
      device.context_.get(), id, device.profiling_ ? CL_QUEUE_PROFILING_ENABLE : 0, &error));
  check_cl(error, "clCreateCommandQueue on " + device.info_.name);
  return device;
}

void Device::finish() const { GIGARAY_CL(clFinish(queue_.get())); }

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

}  // namespace gigaray
