// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <string>

#include "opencl/tuning.h"
#include "src/make_workspace.h"

namespace gigaray::opencl {

/// Parameters by kernel that win over those of lookup_tuning().
using TuningOverrides = std::map<std::string, Tuning>;
/// In their place a part of the device that is done without: FP64 0, INT64_ATOMICS 0,
/// SHARED_MEMORY 0 (with the host), LOCAL_MEMORY but for so many bytes.
inline constexpr const char* kDeviceParts = "device parts";

/// make_opencl_workspace() with other compile-time parameters: what tuning tries.
template <RaySampler S>
std::unique_ptr<Workspace> make_tuned_workspace(const S& sampler, const WorkspaceSetup& setup,
                                                const Device& device,
                                                const TuningOverrides& overrides);

}  // namespace gigaray::opencl
