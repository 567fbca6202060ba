// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "depth_options_cli.h"

#include <fmt/format.h>

#include "depth_range.h"
#include "did_you_mean.h"
#include "gigaray/adapters/feature_ranges.h"
#include "gigaray/adapters/pose_check.h"
#include "gigaray/camera_order.h"
#include "memory_option.h"
#include "numbers.h"
#include "view_layout.h"

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
  app.add_option(
         "--hypotheses", hypotheses,
         "Number of disparities to test, 2 … 4096 (default: 256 for paper, one every 0.035 px for "
         "auto; of photographs with cameras as many as their distances ask for)")
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

BackendChoice DepthRunOptions::backend() const {
  if (device == "reference") return {"reference", ""};
  return {"opencl", device};
}

namespace {

/// Finding direction and range looks at whole pictures, before the plan of the run: refuses large
/// ones that alone don't fit. Whether the run does is the plan's matter.
void require_memory_to_look(const LightField& light_field, const DepthOptions& options) {
  if (light_field.kind == LightFieldKind::kUnstructured) return;
  // A decoded picture, its planes of colours and gradients.
  const double picture = 26.0 * light_field.width * light_field.height;
  constexpr double kLarge = 128 * double(1 << 20);
  if (picture < kLarge) return;
  MemoryBudget(options.memory_bytes / double(1 << 30))
      .require(2 * kProgramBytes + picture,
               views_text(light_field.num_views(), light_field.width, light_field.height));
}

}  // namespace

DepthOptions DepthRunOptions::resolve(LightField& light_field, const RunControl& control) const {
  DepthOptions options = preset_options(preset);
  if (!disparity.empty()) options.disparity = DisparityRange{disparity[0], disparity[1]};
  if (!depth.empty()) options.disparity = range_of_depth(depth, light_field);
  if (hypotheses != 0) options.hypotheses = hypotheses;
  options.most_partners = most_partners;
  options.memory_bytes = memory_gib * double(1 << 30);
  options.work_folder = work_folder;
  options.check();
  check(light_field);
  if (!disparity.empty()) check_inverse_depth(*options.disparity, light_field, control);
  require_memory_to_look(light_field, options);
  check_poses(light_field, input.open.convention.has_value(), control);
  if (!options.disparity) take_range_of_features(light_field, control);
  settle_layout(input, light_field, control);
  if (const auto range = check_direction(light_field, control); range && !options.disparity) {
    options.disparity = range;
    control.message(
        fmt::format("disparity range {:.4g} … {:.4g} px per view step, estimated from the pictures",
                    range->min, range->max));
  }
  return options;
}

}  // namespace gigaray::cli
