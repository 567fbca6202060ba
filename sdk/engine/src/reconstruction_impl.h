// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline.h"

namespace gigaray {

struct Reconstruction::Impl {
  LightField light_field;  ///< as it came, with the axes turned where they were only assumed
  DepthOptions options;
  HypothesisRange hypotheses;  ///< as the engine steps through them
  std::optional<AnySampler> sampler;
  std::vector<Camera> cameras;  ///< unstructured: with the range of each
  RowStore mask;                ///< Pipeline::mask()
  MemoryPlan plan;
  std::unique_ptr<Backend> backend;
  std::string device;
  std::vector<int> views;   ///< ascending
  std::vector<int> active;  ///< as processed
  std::vector<LevelState> levels;
  TupleStore tuples{""};
  std::map<std::string, double> seconds;

  /// What a hypothesis of the engine is to the caller.
  float disparity_of(int view, float hypothesis) const {
    if (cameras.empty()) return hypothesis;
    const InverseDepthRange& range = *cameras[view].inverse_depth;
    return float(range.min + hypothesis * (range.max - range.min));
  }
  /// Takes estimates away where the view shows nothing of the scene.
  void leave_out_masked(int view, ViewDepth& depth) const;
};

}  // namespace gigaray
