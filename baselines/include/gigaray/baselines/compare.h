// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/baselines/contest.h"
#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/memory_budget.h"

namespace gigaray {

/// What this method is to be held against.
struct CompareRequest {
  DepthRequest depth = {};
  /// True disparity of the centre view, of photographs with cameras depth: a map, or a folder with
  /// one. Empty: what the input has.
  std::filesystem::path truth = {};
  std::vector<std::string> methods = {};              ///< of all_methods(); empty: all
  std::vector<std::filesystem::path> externals = {};  ///< descriptions of programs
  int repeats = 1;                                    ///< timed runs, after one that is not
  double error_range = 0;  ///< px with the full colour of an error map; 0: by the number of views
  MemoryBudget memory = MemoryBudget();
};

/// "auto", "paper" and the names of the baselines.
std::vector<std::string> all_methods();

struct Comparison {
  Contest contest;
  std::vector<Contestant> contestants;  ///< ours first
  double error_range = 0;               ///< px
};

/// Runs all methods on an input and scores them. What the reader assumed goes to `control` too.
/// Throws Error(kInvalidArgument) naming the field, kBadInput, kOutOfMemory before the work.
Comparison compare(const InputRequest& input, const CompareRequest& request,
                   const RunControl& control);

/// Writes pictures, compare.csv, compare.json and index.html into a folder that is there. Returns
/// compare.json. input: as the page is to name it; program: the same.
std::string write_comparison(const Comparison& comparison, const std::filesystem::path& folder,
                             const std::string& input, const std::string& program);

}  // namespace gigaray
