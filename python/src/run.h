// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Long calls: the interpreter is free meanwhile, Ctrl-C ends them, progress goes to Python.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "gigaray/core/run_control.h"

namespace gigaray::python {

namespace py = pybind11;

/// A call that a thread of its own works on.
class Job;
/// Does `work` in a thread while the calling one, which holds the interpreter's lock before and
/// after, gives it free, hands progress and messages to the sinks of gigaray._progress and looks
/// for signals. Throws what the work throws; what a signal handler or a sink raises stops the work,
/// which gets a moment to end and is left to itself when it takes longer, as a compiler of kernels
/// may.
void run_job(std::function<void(const RunControl&)> work);

/// Waits for work that was left to itself; at the end of the process, which would pull libraries
/// from under it.
void wait_for_abandoned();

/// What `call` returns. It may outlive the caller: it must own all that it uses.
template <class Call>
auto run(Call call) {
  using Result = std::invoke_result_t<Call&, const RunControl&>;
  if constexpr (std::is_void_v<Result>) {
    run_job(std::move(call));
  } else {
    auto result = std::make_shared<std::optional<Result>>();
    run_job([result, call = std::make_shared<Call>(std::move(call))](const RunControl& control) {
      result->emplace((*call)(control));
    });
    return std::move(**result);
  }
}

}  // namespace gigaray::python
