// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>

#include "opencl/device.h"

namespace gigaray::opencl {

/// Memory of a device, in bytes. Movable; all transfers block and are ordered after the kernels
/// enqueued before. Keeps what it needs of its device alive.
class Buffer {
 public:
  Buffer() = default;

  /// Uninitialised. bytes > 0. Throws Error(kOutOfMemory) with the sizes when the device can't give
  /// that much at once. A device may refuse only when a kernel first uses the buffer.
  Buffer(const Device& device, std::size_t bytes);

  /// A buffer with the content of `data`.
  template <class T>
  Buffer(const Device& device, std::span<const T> data) : Buffer(device, data.size_bytes()) {
    write(data);
  }

  /// Over the caller's memory, which must outlive the buffer: no copy on a device that
  /// shares_host_memory. While the buffer lives, the host looks at it through a Mapping only.
  /// An alignment of 64 bytes lets every CPU driver do without a copy.
  static Buffer over_host_memory(const Device& device, std::span<std::byte> memory);

  /// A buffer of zeros. On a device that shares the host's memory it takes no time: pages are made,
  /// as zeros and large ones, when they are first used.
  static Buffer zeroed(const Device& device, std::size_t bytes);

  std::size_t bytes() const { return bytes_; }
  cl_mem get() const { return memory_.get(); }

  /// Copies to or from the buffer, starting at `offset` bytes.
  template <class T>
  void write(std::span<const T> data, std::size_t offset = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    write_bytes(data.data(), data.size_bytes(), offset);
  }
  template <class T>
  void read(std::span<T> data, std::size_t offset = 0) const {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_const_v<T>);
    read_bytes(data.data(), data.size_bytes(), offset, CL_TRUE);
  }
  /// Does not block: what is read is there when a later command has been waited for.
  void read_later(std::span<std::byte> data) const {
    read_bytes(data.data(), data.size_bytes(), 0, CL_FALSE);
  }

  /// Sets every byte to 0. Does not block.
  void clear();

 private:
  friend class Mapping;
  using Memory = Handle<cl_mem, clRetainMemObject, clReleaseMemObject>;

  void write_bytes(const void* data, std::size_t bytes, std::size_t offset);
  void read_bytes(void* data, std::size_t bytes, std::size_t offset, cl_bool blocking) const;

  Memory memory_;
  Queue queue_;
  std::size_t bytes_ = 0;
};

/// A buffer seen from the host until the end of the scope; no kernel may use it meanwhile.
class Mapping {
 public:
  enum class Access { kRead, kWrite };  ///< kWrite: the old content is kept where not written.

  Mapping(const Buffer& buffer, Access access);
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  template <class T>
  std::span<T> as() const {
    return {static_cast<T*>(data_), bytes_ / sizeof(T)};
  }

 private:
  Buffer::Memory memory_;
  Queue queue_;
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

/// An argument of a kernel: that many bytes of local memory per work-group.
struct LocalMemory {
  std::size_t bytes;
};

/// Work-items in one to three dimensions.
struct WorkSize {
  WorkSize(std::size_t x) : size{x, 1, 1}, dimensions(1) {}
  WorkSize(std::size_t x, std::size_t y) : size{x, y, 1}, dimensions(2) {}
  WorkSize(std::size_t x, std::size_t y, std::size_t z) : size{x, y, z}, dimensions(3) {}

  std::array<std::size_t, 3> size;
  cl_uint dimensions;
};

/// A kernel of a program with its arguments. Movable. An argument buffer must live until the kernel
/// has run.
class Kernel {
 public:
  Kernel() = default;
  /// Throws Error(kDevice) when the program has no kernel of that name.
  Kernel(const Device& device, const Program& program, const std::string& name);

  const std::string& name() const { return name_; }

  /// All arguments in order: buffers, LocalMemory, numbers and structs as the kernel declares them.
  template <class... Args>
  Kernel& set_args(const Args&... args) {
    cl_uint index = 0;
    (set_arg(index++, args), ...);
    return *this;
  }

  /// Enqueues the kernel. Every dimension of `global` must be a multiple of `local`.
  void run(const WorkSize& global, const WorkSize& local) const;

  /// Runs it, waits, and returns the seconds on the device. The device must be open with profiling.
  double run_timed(const WorkSize& global, const WorkSize& local) const;

 private:
  using Object = Handle<cl_kernel, clRetainKernel, clReleaseKernel>;

  template <class T>
  void set_arg(cl_uint index, const T& value) {
    if constexpr (std::is_same_v<T, Buffer>) {
      const cl_mem memory = value.get();
      set_raw_arg(index, sizeof memory, &memory);
    } else if constexpr (std::is_same_v<T, LocalMemory>) {
      set_raw_arg(index, value.bytes, nullptr);
    } else {
      // The sizes of bool, size_t and pointers on the device may differ from the host's.
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> &&
                    !std::is_same_v<T, bool>);
      set_raw_arg(index, sizeof value, &value);
    }
  }
  void set_raw_arg(cl_uint index, std::size_t size, const void* value);
  void enqueue(const WorkSize& global, const WorkSize& local, cl_event* event) const;

  Object kernel_;
  Queue queue_;
  std::shared_ptr<EventLog> log_;
  std::string name_;
};

/// The smallest multiple of `step` that is at least `value`.
inline std::size_t round_up(std::size_t value, std::size_t step) {
  return (value + step - 1) / step * step;
}

}  // namespace gigaray::opencl
