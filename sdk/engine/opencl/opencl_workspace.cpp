// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/opencl_workspace.h"

#include "gigaray/samplers/any_sampler.h"
#include "opencl/device_workspace.h"

namespace gigaray {
namespace opencl {

template <RaySampler S>
std::unique_ptr<Workspace> make_tuned_workspace(const S& sampler, const WorkspaceSetup& setup,
                                                const std::string& device_selection,
                                                const TuningOverrides& overrides) {
  Device device = Device::open(device_selection, Profiling::kOn);
  if (const auto parts = overrides.find(kDeviceParts); parts != overrides.end()) {
    const auto lacks = [&](const char* part) {
      const auto it = parts->second.find(part);
      return it != parts->second.end() && it->second == 0;
    };
    if (lacks("FP64")) device.hide_fp64();
    if (lacks("INT64_ATOMICS")) device.hide_int64_atomics();
  }
  return std::make_unique<DeviceWorkspace>(twin_of(sampler, setup.hypotheses), setup,
                                           std::move(device), overrides);
}

template std::unique_ptr<Workspace> make_tuned_workspace(const EpiSampler&, const WorkspaceSetup&,
                                                         const std::string&,
                                                         const TuningOverrides&);
template std::unique_ptr<Workspace> make_tuned_workspace(const GridSampler&, const WorkspaceSetup&,
                                                         const std::string&,
                                                         const TuningOverrides&);
template std::unique_ptr<Workspace> make_tuned_workspace(const UnstructuredSampler&,
                                                         const WorkspaceSetup&, const std::string&,
                                                         const TuningOverrides&);

}  // namespace opencl

template <RaySampler S>
std::unique_ptr<Workspace> make_opencl_workspace(const S& sampler, const WorkspaceSetup& setup,
                                                 const std::string& device_selection) {
  return opencl::make_tuned_workspace(sampler, setup, device_selection, {});
}

template std::unique_ptr<Workspace> make_opencl_workspace(const EpiSampler&, const WorkspaceSetup&,
                                                          const std::string&);
template std::unique_ptr<Workspace> make_opencl_workspace(const GridSampler&, const WorkspaceSetup&,
                                                          const std::string&);
template std::unique_ptr<Workspace> make_opencl_workspace(const UnstructuredSampler&,
                                                          const WorkspaceSetup&,
                                                          const std::string&);

}  // namespace gigaray
