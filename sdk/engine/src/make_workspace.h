// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gigaray/core/ray_sampler.h"
#include "workspace.h"

namespace gigaray {
namespace opencl {
class Device;
}

/// What a workspace needs to know about a run.
struct WorkspaceSetup {
  DepthOptions options;
  HypothesisRange hypotheses;
  LightFieldKind kind = LightFieldKind::k3D;
  int bit_depth = 8;  ///< of level 0
};

/// Colour of an encoded value 0 … 2^bit_depth − 1 in the working space of the score, in [0, 1].
std::vector<float> colour_table(int bit_depth, bool linear_rgb);

/// Plain loops on one thread. S: a sampler of samplers/ (explicitly instantiated for each).
template <RaySampler S>
std::unique_ptr<Workspace> make_reference_workspace(const S& sampler, const WorkspaceSetup& setup);

/// OpenCL kernels on an open device, in a queue and with kernels of its own: several workspaces of
/// one device may be used at once, each by one thread.
template <RaySampler S>
std::unique_ptr<Workspace> make_opencl_workspace(const S& sampler, const WorkspaceSetup& setup,
                                                 const opencl::Device& device);

}  // namespace gigaray
