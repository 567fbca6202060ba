// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "depth_options_cli.h"

#include "did_you_mean.h"
#include "gigaray/engine/option_table.h"
#include "gigaray/workflows/stated_options.h"
#include "numbers.h"

namespace gigaray::cli {

void add_preset_option(CLI::App& app, std::string& preset) {
  app.add_option("--preset", preset, "auto, or paper: the steps and constants of Kim et al. 2013")
      ->check(one_of({"auto", "paper"}))
      ->capture_default_str();
}

void add_memory_option(CLI::App& app, double& gib, OpenOptions& open) {
  app.add_option_function<double>(
         "--memory",
         [&gib, &open](double value) {
           gib = value;
           open.memory_bytes = value * double(1 << 30);
         },
         "Most memory to use (default: three quarters of what is free); the "
         "result does not depend on it")
      ->check(above_zero())
      ->type_name("GiB");
}

void DepthRunOptions::add_to(CLI::App& app) {
  add_all_but_preset_to(app);
  add_preset_option(app, preset);
  preset_option_ = app.get_option("--preset");
  app.add_option(
         "--partners", most_partners,
         "Photographs with cameras: compare each with so many others, those that share most "
         "of its scene from an angle that tells most (default: all that share enough)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
}

void DepthRunOptions::add_all_but_preset_to(CLI::App& app) {
  input.add_to(app);
  app.add_option(
         "--disparity", disparity,
         "Range to test, px per view step, positive is nearer; of photographs with cameras inverse "
         "depth, 1 / scene unit (default: from the input, else estimated)")
      ->expected(2)
      ->type_name("MIN MAX");
  hypotheses_option_ =
      app.add_option("--hypotheses", hypotheses,
                     "Number of disparities to test, 2 … 4096 (default: 256 for paper, one every "
                     "0.035 px for auto; of photographs with cameras as many as their distances "
                     "ask for)")
          ->type_name("N");
  app.add_option("--device", device,
                 "OpenCL device: index or part of its name, see `gigaray devices`; several with "
                 "commas between (0,1), or `all`, share the rows; `reference` for plain, slow C++")
      ->type_name("D");
  add_memory_option(app, memory_gib, input.open);
  app.add_option("--work", work_folder,
                 "Folder for intermediate data that memory does not hold "
                 "(default: the folder for temporary files)")
      ->type_name("DIR");
}

void DepthRunOptions::add_depth_to(CLI::App& app) {
  app.add_option(
         "--depth", depth,
         "Range to test as distances in scene units, of a rig or of cameras that are known; "
         "FAR may be inf")
      ->expected(2)
      ->excludes(app.get_option("--disparity"))
      ->type_name("NEAR FAR");
}

void DepthRunOptions::add_table_to(CLI::App& app) {
  app.add_option("--set", settings,
                 "One option of the method, as in winner.median_radius=3; may be repeated. "
                 "--list-options names all")
      ->type_name("NAME=VALUE")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--options", options_file,
                 "Options of a JSON file, or those that an earlier result was asked for: its "
                 "folder or its gigaray.json")
      ->type_name("FILE");
  app.add_flag_callback(
      "--list-options", [] { throw CLI::CallForVersion(option_reference(), 0); },
      "Print all options with ranges, units, meaning and defaults, as a table of Markdown");
}

BackendChoice DepthRunOptions::backend() const {
  if (device == "reference") return {"reference", ""};
  return {"opencl", device};
}

DepthOptions DepthRunOptions::stated() const {
  const bool preset_is_stated = preset_option_ && preset_option_->count() > 0;
  DepthOptions options = options_file.empty()
                             ? preset_options(preset)
                             : options_of_file(options_file, preset, preset_is_stated);
  for (const std::string& setting : settings) set_option(setting, options);
  if (!disparity.empty()) options.disparity = DisparityRange{disparity[0], disparity[1]};
  if (hypotheses_option_ && hypotheses_option_->count() > 0) options.hypotheses = hypotheses;
  if (most_partners != 0) options.most_partners = most_partners;
  if (memory_gib != 0) options.memory_bytes = memory_gib * double(1 << 30);
  if (!work_folder.empty()) options.work_folder = work_folder;
  return options;
}

DepthRequest DepthRunOptions::request() const {
  DepthRequest request;
  request.options = stated();
  if (!depth.empty()) request.distances = DistanceRange{depth[0], depth[1]};
  request.backend = backend();
  return request;
}

}  // namespace gigaray::cli
