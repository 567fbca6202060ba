// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <string>

#include "gigaray/backend.h"
#include "opencl/tuning.h"

namespace gigaray::opencl {

/// Parameters by kernel that win over those of lookup_tuning().
using TuningOverrides = std::map<std::string, Tuning>;

/// make_opencl_backend() with other compile-time parameters: what tuning tries.
template <RaySampler S>
std::unique_ptr<Backend> make_tuned_backend(const S& sampler, const BackendSetup& setup,
                                            const std::string& device_selection,
                                            const TuningOverrides& overrides);

}  // namespace gigaray::opencl
