// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/memory_budget.h"
#include "input_options.h"

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
  std::vector<std::string> settings;   ///< NAME=VALUE
  std::filesystem::path options_file;  ///< empty: none

  void add_to(CLI::App& app);
  /// The same without --preset and --partners.
  void add_all_but_preset_to(CLI::App& app);
  /// --depth, of the commands that have no other option of this name; after add_to().
  void add_depth_to(CLI::App& app);
  /// --set, --options and --list-options; after add_to().
  void add_table_to(CLI::App& app);
  BackendChoice backend() const;
  MemoryBudget budget() const { return MemoryBudget(memory_gib); }
  /// Of the preset, the file, --set and the other flags each wins over those before it.
  DepthRequest request() const;
  /// The options of the engine, see prepare_depth().
  DepthOptions resolve(OpenedInput& opened, const RunControl& control) const {
    return prepare_depth(opened, request(), control);
  }

 private:
  DepthOptions stated() const;
  const CLI::Option* preset_option_ = nullptr;
  const CLI::Option* hypotheses_option_ = nullptr;
};

}  // namespace gigaray::cli
