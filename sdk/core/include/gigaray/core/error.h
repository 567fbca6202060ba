// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <stdexcept>
#include <string>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// What kind of thing went wrong; the program maps it to an exit code.
enum class ErrorCode {
  kInvalidArgument,  ///< An option or argument that can't be meant (exit 2).
  kBadInput,         ///< Input data that is missing, damaged or contradictory.
  kIo,               ///< A place that can't be read or written, a full disk.
  kDevice,           ///< No OpenCL device, or a call of it failed.
  kOutOfMemory,      ///< The run does not fit into the memory it was given.
  kCancelled,        ///< The caller asked to stop.
};

/// The one exception type of the SDK. what() is one line for a user: what happened, which file or
/// argument, and what to do. Arguments that can't be meant are kInvalidArgument at every public
/// call (arguments.h); GIGARAY_CHECK is for bugs of the library itself.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

[[noreturn]] void check_failed(const char* file, int line, const char* expression);

}  // namespace gigaray

/// Aborts with file and line when an assumption of the library is false. Never for data of a user
/// or arguments of a caller.
#define GIGARAY_CHECK(expression) \
  ((expression) ? void(0) : ::gigaray::check_failed(__FILE__, __LINE__, #expression))
