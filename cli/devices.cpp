// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "gigaray/engine/device.h"
#include "gigaray/engine/tune.h"

namespace gigaray::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  bool json = false;
  bool clear_cache = false;
  bool tune = false;
  std::string device;
};

std::string readable_size(std::uint64_t bytes) {
  const double mib = double(bytes) / (1 << 20);
  if (mib >= 1024) return fmt::format("{:.1f} GiB", mib / 1024);
  return mib >= 1 ? fmt::format("{:.1f} MiB", mib) : fmt::format("{:.0f} KiB", bytes / 1024.0);
}

std::string to_text(const std::map<std::string, int>& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
  return text;
}

Json to_json(const DeviceInfo& device, int default_index) {
  Json tuning = Json::object();
  for (const auto& kernel : tuning_in_force(device))
    tuning[kernel.kernel] = {{"parameters", kernel.parameters}, {"origin", kernel.origin}};
  return {{"index", device.index},
          {"default", device.index == default_index},
          {"name", device.name},
          {"vendor", device.vendor},
          {"platform", device.platform},
          {"driver_version", device.driver_version},
          {"type", to_string(device.type)},
          {"compute_units", device.compute_units},
          {"global_memory_bytes", device.global_memory},
          {"max_allocation_bytes", device.max_allocation},
          {"local_memory_bytes", device.local_memory},
          {"int64_atomics", device.has_int64_atomics},
          {"fp64", device.has_fp64},
          {"tuning", std::move(tuning)}};
}

void print_json(const std::vector<DeviceInfo>& devices, int default_index,
                const KernelCacheInfo& cache) {
  Json list = Json::array();
  for (const auto& device : devices) list.push_back(to_json(device, default_index));
  const Json result = {{"devices", std::move(list)},
                       {"kernel_cache",
                        {{"folder", cache.folder.empty() ? Json() : Json(cache.folder)},
                         {"programs", cache.programs},
                         {"bytes", cache.bytes}}}};
  // A driver's name need not be UTF-8.
  fmt::print("{}\n", result.dump(2, ' ', false, Json::error_handler_t::replace));
}

void print_table(const std::vector<DeviceInfo>& devices, int default_index,
                 const KernelCacheInfo& cache) {
  for (const auto& device : devices) {
    fmt::print("{} {}: {}{}\n", device.index, to_string(device.type), device.name,
               device.index == default_index ? "  (default)" : "");
    fmt::print("    platform   {}, driver {}\n", device.platform, device.driver_version);
    fmt::print("    hardware   {} compute units, {} memory, {} in one buffer, {} local\n",
               device.compute_units, readable_size(device.global_memory),
               readable_size(device.max_allocation), readable_size(device.local_memory));
    fmt::print("    supports   64-bit atomics: {}, fp64: {}\n",
               device.has_int64_atomics ? "yes" : "no", device.has_fp64 ? "yes" : "no");
    const char* label = "tuning";
    for (const auto& kernel : tuning_in_force(device)) {
      fmt::print("    {:<10} {:<18} {}  ({})\n", label, kernel.kernel, to_text(kernel.parameters),
                 kernel.origin);
      label = "";
    }
  }
  if (cache.folder.empty())
    fmt::print("kernel cache: off\n");
  else
    fmt::print("kernel cache: {}, {} programs, {}\n", cache.folder, cache.programs,
               readable_size(cache.bytes));
}

void list(const Options& options) {
  if (options.clear_cache) clear_kernel_cache();
  // Without any device this is the one line that says so.
  const int default_index = select_devices().front().index;
  const auto devices = list_devices();
  const auto cache = kernel_cache_info();
  if (options.json)
    print_json(devices, default_index, cache);
  else
    print_table(devices, default_index, cache);
}

const char* verdict(const TuneResult& result, int trial) {
  if (!result.trials[trial].failure.empty()) return "can't run";
  if (!result.trials[trial].agrees) return "dropped: differs from the reference";
  if (result.best == trial) return trial == 0 ? "best, as before" : "best, stored";
  return "";
}

Json to_json(const TuneResult& result) {
  Json trials = Json::array();
  for (const TuneTrial& trial : result.trials)
    trials.push_back({{"parameters", trial.parameters},
                      {"agrees", trial.agrees},
                      {"difference", trial.difference},
                      {"seconds", trial.seconds},
                      {"failure", trial.failure.empty() ? Json() : Json(trial.failure)}});
  return {{"kernel", result.kernel},
          {"best", result.best ? Json(*result.best) : Json()},
          {"trials", std::move(trials)}};
}

void tune(const Options& options, const RunControl& control) {
  const DeviceInfo device = select_device(options.device);
  const auto results = tune_device(options.device, control);
  if (options.json) {
    Json kernels = Json::array();
    for (const TuneResult& result : results) kernels.push_back(to_json(result));
    const Json root = {{"device", device.name}, {"kernels", std::move(kernels)}};
    fmt::print("{}\n", root.dump(2, ' ', false, Json::error_handler_t::replace));
    return;
  }
  fmt::print("{}\n{:<18} {:<28} {:>10} {:>12}\n", device.name, "kernel", "setting", "ms",
             "difference");
  for (const TuneResult& result : results)
    for (std::size_t i = 0; i < result.trials.size(); ++i) {
      const TuneTrial& trial = result.trials[i];
      fmt::print("{:<18} {:<28} {:>10.3f} {:>12.2g}  {}\n", i == 0 ? result.kernel : "",
                 to_text(trial.parameters), trial.seconds * 1e3, trial.difference,
                 verdict(result, int(i)));
    }
}

}  // namespace

Run devices_command(CLI::App& app) {
  app.description(
      "List the OpenCL devices, the kernel cache and the tuning in force; tune a device");
  auto options = std::make_shared<Options>();
  app.add_flag("--json", options->json, "Print JSON");
  app.add_flag("--clear-cache", options->clear_cache,
               "First remove the compiled kernels; the tuning stays");
  auto* tuning = app.add_flag(
      "--tune", options->tune,
      "Time the settings of every kernel on a device, store the best of those that give the right "
      "answer; up to a minute");
  app.add_option("--device", options->device, "Device to tune: index, cpu, gpu or part of its name")
      ->needs(tuning);
  return [options](const RunControl& control) {
    if (!options->tune) return list(*options);
    if (options->clear_cache) clear_kernel_cache();
    tune(*options, control);
  };
}

}  // namespace gigaray::cli
