// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// One setting of the compile-time parameters of a kernel, tried on a device.
struct TuneTrial {
  std::map<std::string, int> parameters;  ///< e.g. LANES 16, GROUP 1
  bool agrees = false;                    ///< The answer is that of the reference.
  double difference = 0;                  ///< Largest difference from the reference.
  double seconds = 0;                     ///< Of the fastest of several runs; 0 when not timed.
  std::string failure;                    ///< Why it could not run at all; empty when it could.
};

/// The trials of one kernel, those of the setting in force before first.
struct TuneResult {
  std::string kernel;
  std::vector<TuneTrial> trials;
  std::optional<int> best;  ///< Index of the trial that was stored; empty: none is right.
};

/// The fastest of the trials that agree with the reference. One that is less than 3 % faster than
/// the first, the setting in force before, does not replace it. Empty when none agrees.
std::optional<int> best_trial(const std::vector<TuneTrial>& trials);

/// Tries the settings of every tunable kernel on a device (see select_device()), drops those whose
/// answer differs from the plain reference, and stores the fastest of the others in the kernel
/// cache, where all later runs on this device find it. Takes up to a minute on a CPU. Nothing is
/// stored when it is cancelled. kernels: names of those to tune; empty: all. Throws Error: kDevice,
/// kIo (nowhere to store it), kCancelled.
std::vector<TuneResult> tune_device(const std::string& device, const RunControl& control,
                                    const std::vector<std::string>& kernels = {});

}  // namespace gigaray
