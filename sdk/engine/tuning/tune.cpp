// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/tune.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "gigaray/engine/device.h"
#include "opencl/tuning.h"
#include "tuning/kernel_trial.h"

namespace gigaray {
namespace {

using opencl::Tuning;

constexpr double kWorthwhile = 0.97;   ///< Share of the seconds that a new setting must undercut.
constexpr double kTimedSeconds = 0.1;  ///< Of repeated runs per setting.
/// A setting whose first run takes this many times the fastest, and a second, isn't run again.
constexpr double kHopeless = 4;

/// What a kernel is timed on.
struct Workload {
  TrialShape shape;
  DepthOptions options;
};

std::vector<Workload> workloads_of(const std::string& kernel) {
  TrialShape row;
  row.views_s = 50;
  row.height = 16;
  DepthOptions automatic = auto_options();
  automatic.score.bandwidth = 0.1f;
  automatic.score.gradient_bandwidth = 0.02f;
  if (kernel == "density_score") {
    TrialShape grid;
    grid.views_s = grid.views_t = 7;
    grid.height = 16;
    return {{row, paper_options()}, {grid, automatic}};
  }
  row.views_s = 9;
  return {{row, kernel == "bilateral_median" ? paper_options() : automatic}};
}

/// The settings worth trying: vectors on a CPU, many items per group on a GPU.
std::vector<Tuning> settings_of(const Tuning& in_force, DeviceType type) {
  std::vector<Tuning> settings{in_force};
  const auto add = [&](int lanes, int group, std::optional<int> stage) {
    Tuning setting{{"LANES", lanes}, {"GROUP", group}};
    if (stage) setting["STAGE"] = *stage;
    if (std::find(settings.begin(), settings.end(), setting) == settings.end())
      settings.push_back(std::move(setting));
  };
  const bool can_stage = in_force.contains("STAGE");
  const auto stages = can_stage ? std::vector<std::optional<int>>{1, 0}
                                : std::vector<std::optional<int>>{std::nullopt};
  for (const auto& stage : stages) {
    if (type == DeviceType::kCpu) {
      // Every setting costs a second or two to compile: those that can't win are left out.
      for (const int lanes : {16, 8}) add(lanes, 1, stage);
      if (stage != 0) add(4, 1, stage);
      if (stage == 1) add(1, 16, stage);
    } else {
      for (const int group : {32, 64, 128}) add(1, group, stage);
      add(4, 32, stage);
    }
  }
  return settings;
}

/// A workload with the answer that the reference gives for it.
class Judge {
 public:
  Judge(std::string kernel, const Workload& workload)
      : kernel_(std::move(kernel)),
        check_(KernelTrial::check_shape(workload.shape), workload.options),
        timed_(workload.shape, workload.options) {
    expected_ = check_.answer(*check_.reference(), kernel_);
  }

  Agreement agreement(const Device& device, const Tuning& setting) {
    return KernelTrial::compare(
        kernel_, expected_, check_.answer(*check_.opencl(device, {{kernel_, setting}}), kernel_));
  }

  double seconds(const Device& device, const Tuning& setting) {
    const auto backend = timed_.opencl(device, {{kernel_, setting}});
    timed_.prepare(*backend, kernel_);
    double best = seconds_of_run(*backend);  // slower than the next: it completes the program
    if (best < kHopeless * fastest_ || best < 1)
      for (double total = 0; total < kTimedSeconds;) {
        const double seconds = seconds_of_run(*backend);
        best = std::min(best, seconds);
        total += seconds;
      }
    fastest_ = std::min(fastest_, best);
    return best;
  }

 private:
  double seconds_of_run(TrialBench& backend) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    timed_.run(backend, kernel_);
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  std::string kernel_;
  double fastest_ = 1e30;
  KernelTrial check_, timed_;
  std::vector<float> expected_;
};

TuneTrial try_setting(std::vector<std::unique_ptr<Judge>>& judges, const Device& device,
                      const Tuning& setting) {
  TuneTrial trial;
  trial.parameters = setting;
  try {
    trial.agrees = true;
    for (const auto& judge : judges) {
      const Agreement agreement = judge->agreement(device, setting);
      trial.difference = std::max(trial.difference, agreement.largest);
      trial.agrees = trial.agrees && agreement.good();
    }
    if (trial.agrees)
      for (const auto& judge : judges) trial.seconds += judge->seconds(device, setting);
  } catch (const Error& error) {
    // A setting may ask for more than the device has, such as local memory.
    trial.agrees = false;
    trial.failure = error.what();
  }
  return trial;
}

}  // namespace

std::optional<int> best_trial(const std::vector<TuneTrial>& trials) {
  std::optional<int> best;
  for (int i = 0; i < int(trials.size()); ++i) {
    if (!trials[i].agrees) continue;
    const double bar = best == 0 ? kWorthwhile * trials[0].seconds
                       : best    ? trials[*best].seconds
                                 : trials[i].seconds + 1;
    if (trials[i].seconds < bar) best = i;
  }
  return best;
}

std::vector<TuneResult> tune_device(const std::string& device, const RunControl& control,
                                    const std::vector<std::string>& kernels) {
  const DeviceInfo info = select_device(device);
  if (kernel_cache_info().folder.empty())
    throw Error(ErrorCode::kIo,
                "tuning can't be stored: the kernel cache is off; unset GIGARAY_CACHE or set "
                "GIGARAY_CACHE_DIR to a folder");
  const Device opened = Device::open(std::to_string(info.index));
  const auto& wanted = kernels.empty() ? KernelTrial::kernels() : kernels;
  std::vector<KernelTuning> tunable;
  for (KernelTuning& tuning : tuning_in_force(info))
    if (std::find(wanted.begin(), wanted.end(), tuning.kernel) != wanted.end())
      tunable.push_back(std::move(tuning));
  std::vector<TuneResult> results;
  for (std::size_t i = 0; i < tunable.size(); ++i) {
    const std::string& kernel = tunable[i].kernel;
    std::vector<std::unique_ptr<Judge>> judges;
    for (const Workload& workload : workloads_of(kernel))
      judges.push_back(std::make_unique<Judge>(kernel, workload));
    TuneResult result;
    result.kernel = kernel;
    const auto settings = settings_of(tunable[i].parameters, info.type);
    for (std::size_t k = 0; k < settings.size(); ++k) {
      control.progress("tune", double(i) + double(k) / double(settings.size()),
                       double(tunable.size()));
      result.trials.push_back(try_setting(judges, opened, settings[k]));
    }
    result.best = best_trial(result.trials);
    results.push_back(std::move(result));
  }
  control.progress("tune", double(tunable.size()), double(tunable.size()));
  for (const TuneResult& result : results)
    if (result.best)
      opencl::save_user_tuning(info, result.kernel, result.trials[*result.best].parameters);
  return results;
}

}  // namespace gigaray
