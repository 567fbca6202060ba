// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/depth_scores.h"
#include "gigaray/workflows/memory_budget.h"
#include "gigaray/workflows/scores.h"

namespace GIGARAY_API gigaray {

/// Estimates to be held against a truth.
struct EvaluateRequest {
  /// Maps, or folders as `gigaray depth` writes them.
  std::vector<std::filesystem::path> estimates;
  /// A map, or a scene of a benchmark, see find_view_maps(); of depth see score_depth().
  std::filesystem::path truth;
  std::string views = {};  ///< "centre", "all" or names; empty: the centre, of depth all
  ScoreChoice choice = {};
  bool of_depth = false;   ///< relative errors of depth, in place of errors of disparity
  DepthChoice depth = {};  ///< with of_depth
  std::vector<std::string> masks = {};  ///< NAME=FILE: scores inside of it too; of the centre alone
  MemoryBudget memory = MemoryBudget();
};

/// A map that was scored. view: empty: the only one, or the centre.
struct ScoredMap {
  const std::string& label;
  const std::string& view;
  const FloatMap& estimate;
  const FloatMap& truth;
  bool is_only_one;
};

/// Scores all estimates, of disparity or of depth. look: called with every map of disparity.
/// Throws Error(kBadInput) naming what is missing, damaged or of another size,
/// Error(kInvalidArgument) naming the field, kOutOfMemory before the work.
ScoreTable evaluate(const EvaluateRequest& request, const RunControl& control,
                    const std::function<void(const ScoredMap&)>& look = {});

}  // namespace gigaray
