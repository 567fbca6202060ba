// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/rectify.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/feature_tracks.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/photographs.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/workflows/input.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Features are looked for in one photograph after the other, in scales from twice its size down;
/// later each is straightened by itself. What COLMAP takes is its own.
void require_memory(const RectifyRequest& request, const RailPhotographs& photographs) {
  const double pixels = double(photographs.width) * photographs.height;
  const double matching = 2e6 * double(photographs.pictures.size());
  request.memory.require(
      kProgramBytes + 400 * pixels + matching,
      views_text(int(photographs.pictures.size()), photographs.width, photographs.height));
}

RectifiedRail calibrate(const RailPhotographs& photographs, const RectifyRequest& request,
                        const RunControl& control) {
  for (const std::string& note : photographs.notes) control.message(note);
  if (!photographs.lens_note.empty()) control.message(photographs.lens_note);
  return calibrate_rail(photographs, request.rotations, control);
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
                                         const fs::path& photographs, const RectifyRequest& request,
                                         const RunControl& control) {
  const bool must = request.poses == RailPoses::kColmap;
  std::string why;
  try {
    find_cameras(photographs, request.colmap_folder, colmap_options(in_order, request.lens),
                 {{photographs}, request.replace}, control);
    const RailPhotographs posed = with_colmap_cameras(in_order, request.colmap_folder);
    if (must || posed.pictures.size() == in_order.pictures.size())
      return calibrate(posed, request, control);
    why = fmt::format("COLMAP found only {} of {} cameras", posed.pictures.size(),
                      in_order.pictures.size());
  } catch (const Error& error) {
    const bool is_of_colmap =
        error.code() == ErrorCode::kBadInput || error.code() == ErrorCode::kIo;
    if (must || !is_of_colmap) throw;
    why = error.what();
  }
  control.message(why + "; the order of the photographs is the start instead");
  return calibrate(in_order, request, control);
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
  const ViewSpacing spacing = spacing_of(light_field);
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

}  // namespace

ViewSpacing spacing_of(const LightField& light_field) {
  std::vector<double> positions;
  for (const View& view : light_field.views) positions.push_back(view.s);
  std::vector<double> steps = steps_between(positions);
  std::sort(steps.begin(), steps.end());
  return {steps.front(), steps[steps.size() / 2], steps.back()};
}

RectifiedRail rectify(const RectifyRequest& request, const RunControl& control) {
  const bool is_workspace = has_colmap_model(request.path);
  const fs::path images = request.path / "images";
  const fs::path photographs =
      is_workspace && fs::is_directory(images) ? images : folder_of_photographs(request.path);
  const RailPhotographs in_order = open_rail_in_order(photographs, request.lens);
  require_memory(request, in_order);
  if (request.poses == RailPoses::kOrder) return calibrate(in_order, request, control);
  if (is_workspace) return calibrate(with_colmap_cameras(in_order, request.path), request, control);
  if (!request.colmap_folder.empty())
    return find_cameras_and_calibrate(in_order, photographs, request, control);
  if (request.poses == RailPoses::kColmap)
    throw Error(ErrorCode::kInvalidArgument, "`poses`: COLMAP needs a colmap_folder");
  return calibrate(in_order, request, control);
}

WrittenRail write_rectified(const RectifiedRail& rail, const LightField& light_field,
                            const fs::path& folder, const RunControl& control) {
  WrittenRail written;
  written.files = write_views(light_field, folder, control);
  written.vertical_after = measure_vertical_residual(
      {light_field.num_views(), light_field.pixels->bit_depth(),
       [&](int view) { return read_picture(folder / written.files[std::size_t(view)]); }},
      "measure", control);
  const ordered_json report = report_json(rail, light_field, written.vertical_after);
  const fs::path description = folder / "gigaray.json";
  write_light_field_json(description, light_field, written.files);
  add_report(description, report);
  written.record = report.dump(2);
  return written;
}

}  // namespace gigaray
