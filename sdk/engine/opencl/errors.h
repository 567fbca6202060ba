// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

// OpenCL's own C++ classes own the handles. Their errors come as codes: which call failed, and with
// what sizes, is known where it was made. All of OpenCL comes by this file.
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#include <CL/opencl.hpp>
#include <string>

namespace gigaray::opencl {

/// "CL_OUT_OF_RESOURCES (-5)"
std::string error_name(cl_int error);

/// Throws unless `error` is CL_SUCCESS: Error(kOutOfMemory) when an allocation failed, else
/// Error(kDevice), with `what` (the text of the call, or a sentence) and the error's name.
void check_cl(cl_int error, const std::string& what);

/// GIGARAY_CL(queue.finish()); throws with the text of the call when it fails.
#define GIGARAY_CL(call)                                                        \
  do {                                                                          \
    if (const cl_int gigaray_cl_error = (call); gigaray_cl_error != CL_SUCCESS) \
      ::gigaray::opencl::check_cl(gigaray_cl_error, #call);                     \
  } while (false)

}  // namespace gigaray::opencl
