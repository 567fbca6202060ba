// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "kernels/fma_limit.h"
#include "tuning/kernel_trial.h"

namespace gigaray::benchmarks {

/// The score kernel, beside the multiply-adds that the machine reaches.
void declare_density_score();
/// All other kernels, beside the bytes per second that the machine copies.
void declare_other_steps();

/// The machine that all benchmarks of this process share.
MachineLimit& machine();

/// One kernel on the device. The first use checks its answer on a few pixels against the reference
/// (throws Error(kDevice) when it is wrong), loads the band and runs it once.
class KernelCase {
 public:
  KernelCase(std::string kernel, const TrialShape& shape, const DepthOptions& options)
      : kernel_(std::move(kernel)), shape_(shape), options_(options) {}

  bool make_ready();  ///< Whether this was the first use.
  void run() { trial_->run(*bench_, kernel_); }

  const std::string& kernel() const { return kernel_; }
  const TrialShape& shape() const { return shape_; }
  double pixels() const { return double(shape_.width) * shape_.height; }
  double num_views() const { return double(shape_.views_s) * shape_.views_t; }

 private:
  std::string kernel_;
  TrialShape shape_;
  DepthOptions options_;
  std::optional<KernelTrial> trial_;
  std::unique_ptr<TrialBench> bench_;
};

}  // namespace gigaray::benchmarks
