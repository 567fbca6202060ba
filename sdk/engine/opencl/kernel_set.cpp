// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/kernel_set.h"

#include "opencl/program_cache.h"

namespace gigaray::opencl {

Kernel KernelSet::build(const std::string& file, const std::string& entry,
                        const std::string& options) {
  if (file == kMapSteps) {
    const SourcePart parts[] = {{"kernel_params.h", kernel_source("kernel_params.h")},
                                {"common.cl", kernel_source("common.cl")},
                                {"masks.cl", kernel_source("masks.cl")},
                                {"estimates.cl", kernel_source("estimates.cl")}};
    return Kernel(device_, build_program(device_, parts, options), entry);
  }
  const std::string kernel_file = file + ".cl";
  const SourcePart parts[] = {{"kernel_params.h", kernel_source("kernel_params.h")},
                              {"common.cl", kernel_source("common.cl")},
                              {sampler_file_, kernel_source(sampler_file_)},
                              {kernel_file, kernel_source(kernel_file)}};
  return Kernel(device_, build_program(device_, parts, options + common_), entry);
}

Kernel& KernelSet::plain(const std::string& file, const std::string& entry,
                         const std::string& options) {
  auto [it, is_new] = plain_.try_emplace(entry + options);
  if (is_new) it->second = build(file, entry, options);
  return it->second;
}

LaneKernel& KernelSet::lanes(const std::string& file, const std::string& options, std::string entry,
                             std::size_t vectors) {
  if (entry.empty()) entry = file;
  auto [it, is_new] = lanes_.try_emplace(entry + options);
  if (is_new) {
    Tuning tuning = tuning_of(file);
    const std::size_t item = vectors * std::size_t(tuning.at("LANES")) * sizeof(float);
    while (tuning.at("GROUP") > 1 && item * tuning.at("GROUP") > device_.info().local_memory)
      tuning["GROUP"] /= 2;
    check_local_memory(entry, item * std::size_t(tuning.at("GROUP")));
    const auto stage = tuning.find("STAGE"), units = tuning.find("UNITS");
    it->second = {build(file, entry, defines(tuning) + options), tuning.at("LANES"),
                  tuning.at("GROUP"), units == tuning.end() ? 1 : units->second,
                  stage != tuning.end() && stage->second != 0};
  }
  return it->second;
}

void KernelSet::check_local_memory(const std::string& entry, std::size_t bytes) const {
  const DeviceInfo& info = device_.info();
  if (bytes <= info.local_memory) return;
  const auto kib = [](std::size_t size) { return std::to_string((size + 1023) / 1024) + " KiB"; };
  throw Error(ErrorCode::kDevice, "kernel " + entry + " needs " + kib(bytes) +
                                      " of local memory, device " + info.name + " has " +
                                      kib(info.local_memory) + "; use another --device");
}

Tuning KernelSet::tuning_of(const std::string& kernel) const {
  Tuning tuning = lookup_tuning(device_.info(), kernel);
  if (const auto own = overrides_.find(kernel); own != overrides_.end())
    for (const auto& [name, value] : own->second) tuning[name] = value;
  if (tuning.contains("STAGE")) {
    // Only where local memory holds them.
    const std::size_t bytes = std::size_t(kStagedVectors) * num_views_ * tuning.at("LANES") *
                              tuning.at("GROUP") * sizeof(float);
    if (bytes > device_.info().local_memory) tuning["STAGE"] = 0;
  }
  return tuning;
}

}  // namespace gigaray::opencl
