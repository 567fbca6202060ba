// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coarse_guide.h"
#include "finished_maps.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"
#include "memory_plan.h"
#include "tuple_store.h"
#include "workspace.h"

namespace gigaray {

/// What a run goes by; the same for all its partitions.
struct Run {
  const LightField& light_field;
  const DepthOptions& options;
  HypothesisRange hypotheses;
  const MemoryPlan& plan;
  const RunControl& control;
  const CoarseGuide* guide = nullptr;  ///< null: everything is searched in the whole range
};

/// What it leaves.
struct RunResult {
  FinishedMaps maps;  ///< of the active views
  RunTuples tuples;
  std::vector<LevelSearch> searches;  ///< with DepthOptions::keep_searches
  /// By stage, of the host's work and the devices': of several the slowest.
  std::map<std::string, double> seconds;
};

/// Views that get depth, in the order in which they are worked on: from the centre outwards.
std::vector<int> active_views(const LightField& light_field, const DepthOptions& options);

/// Decodes the pictures and walks over them; each workspace has a part of the rows. The result is
/// the same for any number of them, to the bit.
RunResult run_pipeline(const Run& run, const std::vector<std::unique_ptr<Workspace>>& workspaces);

}  // namespace gigaray
