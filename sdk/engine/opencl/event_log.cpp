// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/event_log.h"

namespace gigaray::opencl {

void EventLog::collect() {
  for (const auto& [stage, event] : pending_) {
    cl_ulong begin = 0, end = 0;
    GIGARAY_CL(event.getProfilingInfo(CL_PROFILING_COMMAND_START, &begin));
    GIGARAY_CL(event.getProfilingInfo(CL_PROFILING_COMMAND_END, &end));
    *stage += double(end - begin) * 1e-9;
  }
  pending_.clear();
}

}  // namespace gigaray::opencl
