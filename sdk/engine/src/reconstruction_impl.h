// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "finished_maps.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/samplers/any_sampler.h"
#include "memory_plan.h"
#include "tuple_store.h"

namespace gigaray {

struct Reconstruction::Impl {
  LightField light_field;  ///< as it came, with the axes turned where they were only assumed
  DepthOptions options;
  HypothesisRange hypotheses;  ///< as the engine steps through them
  std::optional<AnySampler> sampler;
  std::vector<Camera> cameras;  ///< unstructured: with the range of each
  MemoryPlan plan;
  std::string device;
  std::vector<int> views;             ///< ascending
  std::vector<int> active;            ///< as processed
  FinishedMaps maps;                  ///< of the active views
  bool agreed = false;                ///< by view_consensus(), so confidence is calibrated
  std::vector<LevelSearch> searches;  ///< with DepthOptions::keep_searches
  RunTuples tuples;
  std::map<std::string, double> seconds;

  /// What a hypothesis of the engine is to the caller.
  float disparity_of(int view, float hypothesis) const {
    if (cameras.empty()) return hypothesis;
    const InverseDepthRange& range = *cameras[view].inverse_depth;
    return float(range.min + hypothesis * (range.max - range.min));
  }
  /// Place among the active views. Throws Error(kInvalidArgument).
  int active_index(int view) const;
};

}  // namespace gigaray
