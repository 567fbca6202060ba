// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/buffer.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdio>
#include <memory>

namespace gigaray::opencl {
namespace {

std::string readable_size(std::uint64_t bytes) {
  char text[48];
  if (bytes < (1u << 20)) {
    std::snprintf(text, sizeof text, "%llu bytes", static_cast<unsigned long long>(bytes));
  } else {
    const bool giga = bytes >= (1u << 30);
    std::snprintf(text, sizeof text, "%.1f %s", double(bytes) / double(giga ? 1u << 30 : 1u << 20),
                  giga ? "GiB" : "MiB");
  }
  return text;
}

cl::Buffer create(const Device& device, cl_mem_flags flags, std::size_t bytes, void* host) {
  GIGARAY_CHECK(bytes > 0);
  const auto& info = device.info();
  if (bytes > info.max_allocation)
    throw Error(ErrorCode::kOutOfMemory,
                "device " + info.name + ": a buffer of " + readable_size(bytes) +
                    " is larger than its largest allocation of " +
                    readable_size(info.max_allocation) +
                    "; use less DepthOptions::memory_bytes or another device");
  cl_int error = CL_SUCCESS;
  cl::Buffer memory(device.context(), flags, bytes, host, &error);
  if (error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_HOST_MEMORY ||
      error == CL_OUT_OF_RESOURCES)
    throw Error(ErrorCode::kOutOfMemory,
                "device " + info.name + ": no room for a buffer of " + readable_size(bytes) +
                    " in its memory of " + readable_size(info.global_memory) +
                    "; use less DepthOptions::memory_bytes or another device");
  check_cl(error, "clCreateBuffer of " + readable_size(bytes));
  return memory;
}

struct Pages {
  void* begin;
  std::size_t bytes;
};

/// Commands may still use a buffer when its last handle goes; OpenCL calls this when none does.
void CL_CALLBACK unmap_pages(cl_mem, void* data) {
  const std::unique_ptr<Pages> pages(static_cast<Pages*>(data));
  munmap(pages->begin, pages->bytes);
}

std::string to_text(const WorkSize& size) {
  std::string text;
  for (std::size_t i = 0; i < size.dimensions(); ++i)
    text += (i ? " x " : "") + std::to_string(size.get()[i]);
  return text;
}

}  // namespace

Buffer::Buffer(const Device& device, std::size_t bytes)
    : memory_(create(device, CL_MEM_READ_WRITE, bytes, nullptr)),
      queue_(device.queue()),
      bytes_(bytes) {}

Buffer Buffer::over_host_memory(const Device& device, std::span<std::byte> memory, bool read_only) {
  Buffer buffer;
  const cl_mem_flags access = read_only ? CL_MEM_READ_ONLY : CL_MEM_READ_WRITE;
  buffer.memory_ = create(device, access | CL_MEM_USE_HOST_PTR, memory.size(), memory.data());
  buffer.queue_ = device.queue();
  buffer.bytes_ = memory.size();
  return buffer;
}

Buffer Buffer::zeroed(const Device& device, std::size_t bytes) {
  if (!device.info().shares_host_memory) {
    Buffer buffer(device, bytes);
    buffer.clear();
    return buffer;
  }
  constexpr int kProtection = PROT_READ | PROT_WRITE, kFlags = MAP_PRIVATE | MAP_ANONYMOUS;
  void* const begin = mmap(nullptr, bytes, kProtection, kFlags, -1, 0);
  if (begin == MAP_FAILED)
    throw Error(ErrorCode::kOutOfMemory, "no room for a buffer of " + readable_size(bytes) +
                                             "; use less DepthOptions::memory_bytes");
  auto pages = std::make_unique<Pages>(Pages{begin, bytes});
  madvise(begin, bytes, MADV_HUGEPAGE);  // without large pages it is only slower
  Buffer buffer;
  try {
    buffer = over_host_memory(device, {static_cast<std::byte*>(begin), bytes});
    GIGARAY_CL(buffer.memory_.setDestructorCallback(unmap_pages, pages.get()));
  } catch (...) {
    buffer = Buffer();
    munmap(begin, bytes);
    throw;
  }
  pages.release();
  return buffer;
}

void Buffer::write_bytes(const void* data, std::size_t bytes, std::size_t offset) {
  GIGARAY_CHECK(offset <= bytes_ && bytes <= bytes_ - offset);
  if (bytes == 0) return;
  GIGARAY_CL(queue_.enqueueWriteBuffer(memory_, CL_TRUE, offset, bytes, data));
}

void Buffer::read_bytes(void* data, std::size_t bytes, std::size_t offset, cl_bool blocking) const {
  GIGARAY_CHECK(offset <= bytes_ && bytes <= bytes_ - offset);
  if (bytes == 0) return;
  GIGARAY_CL(queue_.enqueueReadBuffer(memory_, blocking, offset, bytes, data));
}

void Buffer::copy_from(const Buffer& other, std::size_t from, std::size_t to, std::size_t bytes) {
  GIGARAY_CHECK(from + bytes <= other.bytes_ && to + bytes <= bytes_);
  GIGARAY_CL(queue_.enqueueCopyBuffer(other.memory_, memory_, from, to, bytes));
}

void Buffer::clear() { GIGARAY_CL(queue_.enqueueFillBuffer(memory_, cl_uchar(0), 0, bytes_)); }

Kernel::Kernel(const Device& device, const cl::Program& program, const std::string& name)
    : queue_(device.queue()), log_(device.log()), name_(name) {
  cl_int error = CL_SUCCESS;
  kernel_ = cl::Kernel(program, name.c_str(), &error);
  check_cl(error, "clCreateKernel of " + name);
}

void Kernel::check_arg(cl_int error, cl_uint index, std::size_t bytes) const {
  if (error != CL_SUCCESS)
    check_cl(error, "argument " + std::to_string(index) + " of kernel " + name_ + " (" +
                        std::to_string(bytes) + " bytes)");
}

void Kernel::run(const WorkSize& global, const WorkSize& local) const {
  GIGARAY_CHECK(global.dimensions() == local.dimensions());
  cl::Event event;
  const cl_int error =
      queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, global, local, nullptr, &event);
  if (error != CL_SUCCESS)
    check_cl(error, "kernel " + name_ + " over " + to_text(global) + " items in groups of " +
                        to_text(local));
  log_->add(std::move(event));
}

}  // namespace gigaray::opencl
