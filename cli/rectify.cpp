// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/rail_rectification.h"
#include "gigaray/workflows/input.h"
#include "gigaray/workflows/rectify.h"
#include "memory_option.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

struct RectifyOptions {
  fs::path input;
  OutputOption out;
  std::optional<double> focal_px;
  std::vector<std::string> lens;  ///< model, then parameters
  std::string rotations = "best";
  std::string poses = "auto";
  std::optional<double> step_mm;
  MemoryBudget memory;
  bool json = false;
};

KnownLens known_lens(const RectifyOptions& options) {
  KnownLens known;
  known.focal_px = options.focal_px;
  if (options.lens.empty()) return known;
  known.lens.emplace().model = options.lens.front();
  for (std::size_t i = 1; i < options.lens.size(); ++i) {
    double value = 0;
    if (!CLI::detail::lexical_cast(options.lens[i], value))
      throw Error(ErrorCode::kInvalidArgument,
                  "--lens: '" + options.lens[i] +
                      "' is not a number; write a COLMAP camera model "
                      "and its parameters, as in RADIAL 800 480 320 -0.1 0.02");
    known.lens->params.push_back(value);
  }
  return known;
}

RailRotations parse_rotations(const std::string& name) {
  return name == "own"      ? RailRotations::kOwn
         : name == "common" ? RailRotations::kCommon
                            : RailRotations::kBest;
}

void print_text(const fs::path& out, const RectifiedRail& rail, const LightField& light_field,
                const ResidualStats& vertical_after) {
  const auto line = [](const char* label, const std::string& text) {
    fmt::print("{:<14}{}\n", label, text);
  };
  const RailReport& report = rail.report;
  const RigGeometry& rig = light_field.rig;
  const std::string unit = rig.unit.empty() ? "" : " " + rig.unit;
  const auto in_unit = [&](double steps) {
    return rig.unit.empty() ? "" : fmt::format(" ({:.3g}{})", steps * *rig.baseline, unit);
  };
  fmt::print("{}: {} views of {} × {} px, a 3D light field\n", out.string(),
             light_field.num_views(), light_field.width, light_field.height);
  if (report.line) {
    const double rms = report.line->rms_distance / report.line->median_step;
    const double max = report.line->max_distance / report.line->median_step;
    line("line", fmt::format("cameras beside it by {:.3g} steps{} rms, {:.3g}{} at most", rms,
                             in_unit(rms), max, in_unit(max)));
  }
  line("cameras from", rail.posed ? "COLMAP" : "the order of the photographs");
  line("rotations", fmt::format("{}, the cameras turn by {:.3g}° rms",
                                report.own_rotations ? "each picture's own" : "one for all",
                                report.rotation_rms_deg));
  line("reprojection",
       fmt::format("{:.3g} px rms, {} tracks, {:.3g} % of the sightings rejected",
                   report.reprojection.rms, report.num_tracks, 100 * report.rejected_share));
  line("rows differ",
       fmt::format("by {:.3g} px (95 %: {:.3g}) before, {:.3g} px (95 %: {:.3g}) now",
                   report.vertical_before.median, report.vertical_before.percentile_95,
                   vertical_after.median, vertical_after.percentile_95));
  const ViewSpacing spacing = spacing_of(light_field);
  line("spacing", fmt::format("{:.3g} … {:.3g} … {:.3g} view steps{}", spacing.min, spacing.median,
                              spacing.max, in_unit(1)));
}

void rectify(const RectifyOptions& options, const RunControl& control) {
  if (options.step_mm && !(*options.step_mm > 0))
    throw Error(ErrorCode::kInvalidArgument, "--rail-step must be more than 0 mm");
  AtomicFolder out(options.out.path, kLightFieldFormat, options.out.rules({options.input}));
  RectifyRequest request{options.input, known_lens(options), parse_rotations(options.rotations)};
  request.poses = options.poses == "order"    ? RailPoses::kOrder
                  : options.poses == "colmap" ? RailPoses::kColmap
                                              : RailPoses::kAuto;
  request.colmap_folder = colmap_folder_beside(options.out.path);
  request.replace = options.out.replace;
  request.memory = options.memory;
  const RectifiedRail rail = gigaray::rectify(request, control);
  const LightField light_field = rectified_light_field(rail, options.step_mm);
  check(light_field);
  const WrittenRail written = write_rectified(rail, light_field, out.path(), control);
  out.commit(control);
  if (options.json)
    fmt::print("{}\n", written.record);
  else
    print_text(options.out.path, rail, light_field, written.vertical_after);
}

}  // namespace

Run rectify_command(CLI::App& app) {
  app.description("Photographs taken on a rail become a 3D light field: undistorted, rectified");
  auto options = std::make_shared<RectifyOptions>();
  app.add_option("INPUT", options->input,
                 "Folder of photographs, numbered along the rail, or a COLMAP workspace")
      ->required();
  options->out.add_to(app, "Folder for the light field")->required();
  auto* focal = app.add_option("--focal", options->focal_px,
                               "Focal length, px; without it that of the EXIF data");
  app.add_option("--lens", options->lens,
                 "All of the lens: a COLMAP camera model and its parameters, as in RADIAL 800 480 "
                 "320 -0.1 0.02; without it the radial distortion is found")
      ->type_name("MODEL NUMBER...")
      ->expected(2, 20)
      ->excludes(focal);
  app.add_option("--rotations", options->rotations,
                 "Each picture is rectified by its camera's own rotation or by one common to all; "
                 "best: whichever leaves less between the rows")
      ->check(one_of({"best", "own", "common"}))
      ->capture_default_str();
  app.add_option("--poses", options->poses,
                 "What to start from: the cameras that COLMAP finds, the order of the photographs, "
                 "or auto: COLMAP, the order where that fails; a COLMAP workspace has them")
      ->check(one_of({"auto", "colmap", "order"}))
      ->capture_default_str();
  app.add_option("--rail-step", options->step_mm,
                 "Mean distance of neighbouring cameras: depth will be in mm")
      ->type_name("MM");
  add_memory_option(app, options->memory,
                    "some 400 bytes per pixel of a photograph, and what COLMAP takes, which "
                    "has no limit");
  app.add_flag("--json", options->json, "Print JSON");
  return [options](const RunControl& control) { rectify(*options, control); };
}

}  // namespace gigaray::cli
