// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "kernels/kernel_benchmarks.h"
#include "support/program.h"

namespace gigaray::benchmarks {

MachineLimit& machine() {
  static MachineLimit limit;
  return limit;
}

bool KernelCase::make_ready() {
  if (bench_) return false;
  KernelTrial check(KernelTrial::check_shape(shape_), options_);
  const auto expected = check.answer(*check.reference(), kernel_);
  const auto actual = check.answer(*check.opencl(""), kernel_);
  const Agreement agreement = KernelTrial::compare(kernel_, expected, actual);
  if (!agreement.good())
    throw Error(ErrorCode::kDevice, kernel_ + " is wrong on this device: " +
                                        std::to_string(100 * agreement.share_apart) +
                                        " % of the values differ from the reference, by up to " +
                                        std::to_string(agreement.largest));
  trial_.emplace(shape_, options_);
  auto bench = trial_->opencl("");
  trial_->prepare(*bench, kernel_);
  trial_->run(*bench, kernel_);
  bench_ = std::move(bench);
  return true;
}

}  // namespace gigaray::benchmarks

int main(int argc, char** argv) {
  using namespace gigaray::benchmarks;
  return run_program(argc, argv, [](const std::vector<std::string>& arguments) {
    if (!arguments.empty())
      throw gigaray::Error(gigaray::ErrorCode::kInvalidArgument,
                           arguments[0] +
                               ": unknown option; there are --benchmark_filter and the "
                               "others of Google Benchmark");
    declare_density_score();
    declare_other_steps();
  });
}
