// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <stdexcept>
#include <string>

namespace gigaray {

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
/// option, and what to do. Bugs of the caller are asserted with GIGARAY_CHECK instead.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

[[noreturn]] void check_failed(const char* file, int line, const char* expression);

}  // namespace gigaray

/// Aborts with file and line when a programmer's assumption is false. Never for user data.
#define GIGARAY_CHECK(expression) \
  ((expression) ? void(0) : ::gigaray::check_failed(__FILE__, __LINE__, #expression))
