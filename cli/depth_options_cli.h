// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "gigaray/reconstruct.h"
#include "input_options.h"
#include "memory_option.h"

namespace gigaray::cli {

/// --preset and --memory, for the commands that have not all of DepthRunOptions.
void add_preset_option(CLI::App& app, std::string& preset);
void add_memory_option(CLI::App& app, double& gib, OpenOptions& open);

/// INPUT and the options that decide the result; shared by `depth`, `probe` and `compare`.
struct DepthRunOptions {
  InputOptions input;
  std::string preset = "auto";
  std::vector<double> disparity;  ///< empty or MIN MAX
  std::vector<double> depth;      ///< empty or NEAR FAR
  int hypotheses = 0;
  int most_partners = 0;  ///< of unstructured views; 0: all
  std::string device;
  double memory_gib = 0;
  std::string work_folder;

  void add_to(CLI::App& app);
  /// The same without --preset and --partners.
  void add_all_but_preset_to(CLI::App& app);
  /// --depth, of the commands that have no other option of this name; after add_to().
  void add_depth_to(CLI::App& app);
  BackendChoice backend() const;
  MemoryBudget budget() const { return MemoryBudget(memory_gib); }
  /// The options of the engine. Checks the direction of travel, which may turn the axes of the
  /// light field around.
  DepthOptions resolve(LightField& light_field, const RunControl& control) const;
};

}  // namespace gigaray::cli
