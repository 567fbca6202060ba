// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/error.h"

namespace GIGARAY_API gigaray {

/// Throws Error(kInvalidArgument) with `what`, one line that names the argument, unless it holds.
/// For the arguments of public calls.
inline void require_argument(bool holds, const char* what) {
  if (!holds) throw Error(ErrorCode::kInvalidArgument, what);
}

/// What `call` returns. Memory that it asked for and did not get becomes Error(kOutOfMemory): for
/// public calls whose sizes the caller decides. what: what takes it, for the message.
template <class Call>
auto with_memory_errors(const char* what, const Call& call) {
  const auto error = [&] {
    return Error(ErrorCode::kOutOfMemory, std::string("out of memory for ") + what +
                                              "; use a smaller input or a smaller limit of memory");
  };
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw error();
  } catch (const std::length_error&) {  // more than memory can count
    throw error();
  }
}

}  // namespace gigaray
