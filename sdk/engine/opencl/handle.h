// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <string>
#include <utility>

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
using Event = Handle<cl_event, clRetainEvent, clReleaseEvent>;

}  // namespace gigaray::opencl
