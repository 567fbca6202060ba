// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/view_sets.h"
#include "src/workspace.h"

namespace gigaray::opencl {

/// What a workspace needs of a sampler, whichever it is: of all views, or of those in a band; `ref`
/// counts among them.
struct SamplerTwin {
  std::string kernel_file;
  bool rays_shift_alike = true;
  int num_views = 0;
  std::function<std::vector<float>(int ref)> ray_table;
  std::function<std::vector<std::uint8_t>(int ref, ScoreViews views)> score_members;
  std::function<SamplerTwin(const std::vector<int>& views, int level)> of_band;
};

template <RaySampler S>
SamplerTwin twin_of(const S& sampler, const HypothesisRange& hypotheses) {
  return {std::string(S::kKernelFile),
          S::kRaysShiftAlike,
          sampler.num_views(),
          [sampler](int ref) { return sampler.ray_table(ref); },
          [sampler, hypotheses](int ref, ScoreViews views) {
            return score_members(sampler, ref, views, hypotheses);
          },
          [sampler, hypotheses](const std::vector<int>& views, int level) {
            return twin_of(sampler.subset(views).at_level(level), hypotheses);
          }};
}

}  // namespace gigaray::opencl
