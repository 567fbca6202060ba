// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/feature_tracks.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/photographs.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/rail_rectification.h"
#include "memory_option.h"
#include "output_option.h"
#include "photographs.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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

/// Features are looked for in one photograph after the other, in scales from twice its size down;
/// later each is straightened by itself. What COLMAP takes is its own.
void require_memory(const RectifyOptions& options, const RailPhotographs& photographs) {
  const double pixels = double(photographs.width) * photographs.height;
  const double matching = 2e6 * double(photographs.pictures.size());
  options.memory.require(
      kProgramBytes + 400 * pixels + matching,
      views_text(int(photographs.pictures.size()), photographs.width, photographs.height));
}

RailRotations parse_rotations(const std::string& name) {
  return name == "own"      ? RailRotations::kOwn
         : name == "common" ? RailRotations::kCommon
                            : RailRotations::kBest;
}

RectifiedRail calibrate(const RailPhotographs& photographs, const RectifyOptions& options,
                        const RunControl& control) {
  for (const std::string& note : photographs.notes) control.message(note);
  if (!photographs.lens_note.empty()) control.message(photographs.lens_note);
  return calibrate_rail(photographs, parse_rotations(options.rotations), control);
}

/// What COLMAP is told about the lens: all of it, or a focal length to begin with.
ColmapRunOptions colmap_options(const RailPhotographs& photographs, const KnownLens& known) {
  ColmapRunOptions options;
  options.quality = ColmapQuality::kHigh;
  if (!known.lens && !known.focal_px) return options;
  options.lens = photographs.pictures.front().lens;
  options.refine_lens = !known.lens;
  if (options.refine_lens) {
    options.lens->model = "SIMPLE_RADIAL";
    options.lens->params.push_back(0);
  }
  return options;
}

/// With the cameras that COLMAP finds. Where it finds too few or no rail, which happens when all
/// stand on a line, with the order of the photographs.
RectifiedRail find_cameras_and_calibrate(const RailPhotographs& in_order,
                                         const fs::path& photographs, const KnownLens& known,
                                         const RectifyOptions& options, const RunControl& control) {
  const bool must = options.poses == "colmap";
  std::string why;
  try {
    const fs::path workspace =
        find_cameras(photographs, colmap_options(in_order, known), options.out, control);
    const RailPhotographs posed = with_colmap_cameras(in_order, workspace);
    if (must || posed.pictures.size() == in_order.pictures.size())
      return calibrate(posed, options, control);
    why = fmt::format("COLMAP found only {} of {} cameras", posed.pictures.size(),
                      in_order.pictures.size());
  } catch (const Error& error) {
    const bool is_of_colmap =
        error.code() == ErrorCode::kBadInput || error.code() == ErrorCode::kIo;
    if (must || !is_of_colmap) throw;
    why = error.what();
  }
  control.message(why + "; the order of the photographs is the start instead");
  return calibrate(in_order, options, control);
}

/// Writes the views into a folder, one file each; returns their names.
std::vector<std::string> write_views(const LightField& light_field, const fs::path& folder,
                                     const RunControl& control) {
  std::vector<std::string> files;
  for (int view = 0; view < light_field.num_views(); ++view) {
    control.progress("rectify", view, light_field.num_views());
    files.push_back(light_field.views[view].name + ".png");
    write_png(folder / files.back(), light_field.pixels->read(view),
              light_field.pixels->bit_depth());
  }
  control.progress("rectify", light_field.num_views(), light_field.num_views());
  return files;
}

struct Spacing {
  double min = 0, median = 0, max = 0;  ///< in median steps
};

Spacing spacing_of(const LightField& light_field) {
  std::vector<double> positions;
  for (const View& view : light_field.views) positions.push_back(view.s);
  std::vector<double> steps = steps_between(positions);
  std::sort(steps.begin(), steps.end());
  return {steps.front(), steps[steps.size() / 2], steps.back()};
}

ordered_json stats_json(const ResidualStats& stats) {
  return {{"median_px", stats.median}, {"percentile_95_px", stats.percentile_95}};
}

/// How to find a pixel of a rectified view in its photograph.
ordered_json sources_json(const RectifiedRail& rail) {
  ordered_json sources = ordered_json::array();
  for (std::size_t i = 0; i < rail.pictures.size(); ++i) {
    const RailSource source = source_of(rail, int(i));
    ordered_json rotation = ordered_json::array();
    for (int row = 0; row < 3; ++row)
      rotation.push_back(
          {source.rotation(row, 0), source.rotation(row, 1), source.rotation(row, 2)});
    sources.push_back({{"file", rail.pictures[i].file.filename().string()},
                       {"rotation", rotation},
                       {"lens", {{"model", source.lens.model}, {"params", source.lens.params}}}});
  }
  return sources;
}

ordered_json report_json(const RectifiedRail& rail, const LightField& light_field,
                         const ResidualStats& vertical_after) {
  const RailReport& report = rail.report;
  const Spacing spacing = spacing_of(light_field);
  ordered_json line = nullptr;
  if (report.line) {
    const double step = report.line->median_step;
    line = {{"rms_steps", report.line->rms_distance / step},
            {"max_steps", report.line->max_distance / step}};
  }
  return {
      {"cameras", rail.pictures.size()},
      {"poses", rail.posed ? "COLMAP" : "known order"},
      {"line_residual", line},
      {"rotations", report.own_rotations ? "own" : "common"},
      {"rotation_rms_deg", report.rotation_rms_deg},
      {"reprojection_rms_px", report.reprojection.rms},
      {"tracks", report.num_tracks},
      {"rejected_share", report.rejected_share},
      {"vertical_residual_before", stats_json(report.vertical_before)},
      {"vertical_residual_after", stats_json(vertical_after)},
      {"spacing_steps", {{"min", spacing.min}, {"median", spacing.median}, {"max", spacing.max}}},
      {"focal_px", rail.camera.focal_u},
      {"principal_point_px", {rail.camera.centre_u, rail.camera.centre_v}},
      {"photographs", sources_json(rail)}};
}

void add_report(const fs::path& description, const ordered_json& report) {
  ordered_json root;
  std::ifstream(description) >> root;
  root["rectify"] = report;
  write_file_atomically(description, root.dump(2) + "\n");
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
  const Spacing spacing = spacing_of(light_field);
  line("spacing", fmt::format("{:.3g} … {:.3g} … {:.3g} view steps{}", spacing.min, spacing.median,
                              spacing.max, in_unit(1)));
}

void rectify(const RectifyOptions& options, const RunControl& control) {
  if (options.step_mm && !(*options.step_mm > 0))
    throw Error(ErrorCode::kInvalidArgument, "--rail-step must be more than 0 mm");
  AtomicFolder out(options.out.path, kLightFieldFormat, options.out.rules({options.input}));
  const bool is_workspace = has_colmap_model(options.input);
  const fs::path images = options.input / "images";
  const fs::path photographs =
      is_workspace && fs::is_directory(images) ? images : folder_of_photographs(options.input);
  const KnownLens known = known_lens(options);
  const RailPhotographs in_order = open_rail_in_order(photographs, known);
  require_memory(options, in_order);
  const RectifiedRail rail =
      options.poses == "order" ? calibrate(in_order, options, control)
      : is_workspace ? calibrate(with_colmap_cameras(in_order, options.input), options, control)
                     : find_cameras_and_calibrate(in_order, photographs, known, options, control);
  const LightField light_field = rectified_light_field(rail, options.step_mm);
  check(light_field);

  const std::vector<std::string> files = write_views(light_field, out.path(), control);
  const ResidualStats vertical_after =
      measure_vertical_residual({light_field.num_views(), light_field.pixels->bit_depth(),
                                 [&](int view) { return read_picture(out.path() / files[view]); }},
                                "measure", control);
  const ordered_json report = report_json(rail, light_field, vertical_after);
  const fs::path description = out.path() / "gigaray.json";
  write_light_field_json(description, light_field, files);
  add_report(description, report);
  out.commit(control);
  if (options.json)
    fmt::print("{}\n", report.dump(2));
  else
    print_text(options.out.path, rail, light_field, vertical_after);
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
  options->memory.add_to(app,
                         "some 400 bytes per pixel of a photograph, and what COLMAP takes, which "
                         "has no limit");
  app.add_flag("--json", options->json, "Print JSON");
  return [options](const RunControl& control) { rectify(*options, control); };
}

}  // namespace gigaray::cli
