// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/kernel_set.h"

#include <algorithm>

#include "opencl/program_cache.h"

namespace gigaray::opencl {
namespace {

/// Does `all` give every parameter of `some` that it has the same value?
bool agree(const Tuning& some, const Tuning& all) {
  return std::all_of(some.begin(), some.end(), [&](const auto& parameter) {
    const auto it = all.find(parameter.first);
    return it == all.end() || it->second == parameter.second;
  });
}

}  // namespace

void KernelSet::join(const std::vector<KernelFile>& files) {
  for (const KernelFile& file : files) {
    Tuning tuning = tuning_of(file.name);
    if (!agree(tuning, joined_tuning_)) continue;
    joined_tuning_.merge(tuning);
    joined_.push_back(file);
  }
}

Kernel KernelSet::build(const std::string& file, const std::string& entry,
                        const std::string& options, const Tuning& tuning) {
  std::vector<std::string> names{"kernel_params.h", "common.cl"};
  std::string all_options = defines(tuning) + options;
  if (file == kMapSteps) {
    names.insert(names.end(), {"masks.cl", "estimates.cl"});
  } else {
    names.push_back(sampler_file_);
    const bool is_joined =
        agree(tuning, joined_tuning_) &&
        std::any_of(joined_.begin(), joined_.end(), [&](const KernelFile& joined) {
          return joined.name == file && joined.options == options;
        });
    if (is_joined) {
      all_options = defines(joined_tuning_);
      for (const KernelFile& joined : joined_) {
        names.push_back(joined.name + ".cl");
        all_options += joined.options;
      }
    } else {
      names.push_back(file + ".cl");
    }
    all_options += common_;
  }
  std::vector<SourcePart> parts;
  for (const std::string& name : names) {
    parts.push_back({name, kernel_source(name)});
    GIGARAY_CHECK(!parts.back().text.empty());
  }
  return Kernel(device_, build_program(device_, parts, all_options), entry);
}

Kernel& KernelSet::plain(const std::string& file, const std::string& entry,
                         const std::string& options) {
  auto [it, is_new] = plain_.try_emplace(entry + options);
  if (is_new) it->second = build(file, entry, options, {});
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
    it->second = {build(file, entry, options, tuning), tuning.at("LANES"), tuning.at("GROUP"),
                  units == tuning.end() ? 1 : units->second,
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
                                      kib(info.local_memory) + "; use another device");
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
