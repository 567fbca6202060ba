// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
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
  /// shares_host_memory. While the buffer lives, the host looks at it through read() and write().
  /// An alignment of 64 bytes lets every CPU driver do without a copy.
  /// read_only: kernels don't write it, so several buffers may lie over the same memory.
  static Buffer over_host_memory(const Device& device, std::span<std::byte> memory,
                                 bool read_only = false);

  /// A buffer of zeros. On a device that shares the host's memory it takes no time: pages are made,
  /// as zeros and large ones, when they are first used.
  static Buffer zeroed(const Device& device, std::size_t bytes);

  std::size_t bytes() const { return bytes_; }
  const cl::Buffer& get() const { return memory_; }

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
  void read_later(std::span<std::byte> data, std::size_t offset = 0) const {
    read_bytes(data.data(), data.size_bytes(), offset, CL_FALSE);
  }

  /// Sets every byte to 0. Does not block.
  void clear();
  /// Copies bytes of another buffer, or of another part of this one. Does not block.
  void copy_from(const Buffer& other, std::size_t from, std::size_t to, std::size_t bytes);

 private:
  void write_bytes(const void* data, std::size_t bytes, std::size_t offset);
  void read_bytes(void* data, std::size_t bytes, std::size_t offset, cl_bool blocking) const;

  cl::Buffer memory_;
  cl::CommandQueue queue_;
  std::size_t bytes_ = 0;
};

/// An argument of a kernel: that many bytes of local memory per work-group.
using LocalMemory = cl::LocalSpaceArg;

/// Work-items in one to three dimensions.
using WorkSize = cl::NDRange;

/// A kernel of a program with its arguments. Movable. An argument buffer must live until the kernel
/// has run.
class Kernel {
 public:
  Kernel() = default;
  /// Throws Error(kDevice) when the program has no kernel of that name.
  Kernel(const Device& device, const cl::Program& program, const std::string& name);

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

 private:
  template <class T>
  void set_arg(cl_uint index, const T& value) {
    if constexpr (std::is_same_v<T, Buffer>) {
      check_arg(kernel_.setArg(index, value.get()), index, sizeof(cl_mem));
    } else if constexpr (std::is_same_v<T, LocalMemory>) {
      check_arg(kernel_.setArg(index, value), index, value.size_);
    } else {
      // The sizes of bool, size_t and pointers on the device may differ from the host's.
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> &&
                    !std::is_same_v<T, bool>);
      check_arg(kernel_.setArg(index, sizeof value, &value), index, sizeof value);
    }
  }
  void check_arg(cl_int error, cl_uint index, std::size_t bytes) const;

  cl::Kernel kernel_;
  cl::CommandQueue queue_;
  std::shared_ptr<EventLog> log_;
  std::string name_;
};

/// The smallest multiple of `step` that is at least `value`.
inline std::size_t round_up(std::size_t value, std::size_t step) {
  return (value + step - 1) / step * step;
}

}  // namespace gigaray::opencl
