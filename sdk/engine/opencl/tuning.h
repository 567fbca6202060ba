// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/engine/device.h"

namespace gigaray::opencl {

/// Compile-time parameters of a kernel: LANES 16, STAGE 1, …
using Tuning = std::map<std::string, int>;

/// One line of a tuning table; the format is described in tuning/kernel_tuning.txt.
struct TuningRule {
  enum class Scope { kAny, kType, kVendor, kDevice };  ///< From general to special.

  Scope scope = Scope::kAny;
  std::string pattern;  ///< Part of the name in any case; "cpu" and so on for kType.
  std::string kernel;
  Tuning parameters;

  bool matches(const DeviceInfo& device) const;
};

/// The rules of a table. Lines that are no rule are left out and, if asked for, collected: a
/// damaged file of a user must not stop a run.
std::vector<TuningRule> parse_tuning(std::string_view text,
                                     std::vector<std::string>* rejected = nullptr);

/// The parameters of a kernel on a device: those of all matching rules, where the more special
/// scope wins parameter by parameter, in one scope the later line, and a rule of the user over all.
Tuning lookup_tuning(const DeviceInfo& device, std::string_view kernel);

/// "-DLANES=16 -DSTAGE=1": options for build_program().
std::string defines(const Tuning& tuning);

/// Stores a result of tuning in the cache folder, in place of an older one for this device and
/// kernel; lookup_tuning() prefers it from now on. Throws Error(kIo) when that can't be written.
void save_user_tuning(const DeviceInfo& device, std::string_view kernel, const Tuning& tuning);

}  // namespace gigaray::opencl
