// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/opencl_workspace.h"

#include "gigaray/samplers/any_sampler.h"
#include "opencl/device_workspace.h"

namespace gigaray {
namespace opencl {

template <RaySampler S>
std::unique_ptr<Workspace> make_tuned_workspace(const S& sampler, const WorkspaceSetup& setup,
                                                const Device& opened,
                                                const TuningOverrides& overrides) {
  Device device = opened;
  if (const auto parts = overrides.find(kDeviceParts); parts != overrides.end()) {
    const auto lacks = [&](const char* part) {
      const auto it = parts->second.find(part);
      return it != parts->second.end() && it->second == 0;
    };
    if (lacks("FP64")) device.hide_fp64();
    if (lacks("INT64_ATOMICS")) device.hide_int64_atomics();
    if (lacks("SHARED_MEMORY")) device.hide_shared_memory();
    if (const auto local = parts->second.find("LOCAL_MEMORY"); local != parts->second.end())
      device.hide_local_memory(std::size_t(local->second));
  }
  return std::make_unique<DeviceWorkspace>(twin_of(sampler, setup.hypotheses), setup, device,
                                           overrides);
}

template std::unique_ptr<Workspace> make_tuned_workspace(const EpiSampler&, const WorkspaceSetup&,
                                                         const Device&, const TuningOverrides&);
template std::unique_ptr<Workspace> make_tuned_workspace(const GridSampler&, const WorkspaceSetup&,
                                                         const Device&, const TuningOverrides&);
template std::unique_ptr<Workspace> make_tuned_workspace(const UnstructuredSampler&,
                                                         const WorkspaceSetup&, const Device&,
                                                         const TuningOverrides&);

}  // namespace opencl

template <RaySampler S>
std::unique_ptr<Workspace> make_opencl_workspace(const S& sampler, const WorkspaceSetup& setup,
                                                 const opencl::Device& device) {
  return opencl::make_tuned_workspace(sampler, setup, device, {});
}

template std::unique_ptr<Workspace> make_opencl_workspace(const EpiSampler&, const WorkspaceSetup&,
                                                          const opencl::Device&);
template std::unique_ptr<Workspace> make_opencl_workspace(const GridSampler&, const WorkspaceSetup&,
                                                          const opencl::Device&);
template std::unique_ptr<Workspace> make_opencl_workspace(const UnstructuredSampler&,
                                                          const WorkspaceSetup&,
                                                          const opencl::Device&);

}  // namespace gigaray
