// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "command.h"
#include "gigaray/adapters/cloud_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/workflows/surface.h"
#include "memory_option.h"
#include "numbers.h"
#include "output_option.h"
#include "points_options.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

struct Settings {
  PointsOptions input;
  CloudRequest request;
  OutputOption output;
  bool json = false;
};

void run(const Settings& settings, const RunControl& control) {
  CloudFile file(
      AtomicFile(settings.output.path, settings.input.rules(settings.output), {".ply", ".pcd"}),
      settings.output.path.extension() == ".pcd" ? CloudFormat::kPcd : CloudFormat::kPly);
  const auto begin = std::chrono::steady_clock::now();
  const ScenePoints points = settings.input.open(control);
  const CloudReport report = cloud_of(
      points, settings.request, [&](const PointCloud& tile) { file.add(tile); }, control);
  file.commit(control);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  if (settings.json) {
    const ordered_json root{{"format", "gigaray cloud"},
                            {"version", 1},
                            {"file", path_text(settings.output.path)},
                            {"filters", as_json(report.pixels)},
                            {"voxel", report.voxel},
                            {"merged", report.merged},
                            {"outliers", report.outliers},
                            {"points", report.points},
                            {"tiles", report.tiles},
                            {"bytes_on_disk", report.bytes_on_disk},
                            {"origin", origin_json(report.origin)},
                            {"seconds", seconds}};
    fmt::print("{}\n", root.dump(2));
    return;
  }
  print(report.pixels, points.views.size(), points.options);
  fmt::print("merged        {} points into {}, one per cube of {}{:.4g}\n", report.pixels.points,
             report.merged, settings.request.cloud.voxel > 0 ? "" : "pixel size, usually ",
             report.voxel);
  fmt::print("outliers      {} that stand alone\n", report.outliers);
  print_origin(report.origin);
  fmt::print("{}: {} points in {:.1f} s\n", settings.output.path.string(), report.points, seconds);
}

}  // namespace

Run cloud_command(CLI::App& app) {
  app.description("One coloured, oriented point cloud of all views");
  const auto settings = std::make_shared<Settings>();
  settings->input.declare(app);
  settings->output.add_to(app, "scene.ply, or scene.pcd for PCL", "FILE")->required();
  app.add_option("--voxel", settings->request.cloud.voxel,
                 "Points in a cube of this size become one, scene units (default: the distance of "
                 "neighbouring pixels there, in steps of two)")
      ->check(above_zero())
      ->type_name("SIZE");
  app.add_option("--outliers", settings->request.cloud.outlier_deviations,
                 "Drop points whose neighbours are farther than usual by so many standard "
                 "deviations; 0: none")
      ->check(zero_or_more())
      ->type_name("X")
      ->capture_default_str();
  add_memory_option(app, settings->request.memory,
                    "up to 52 bytes per pixel of all views; points that don't fit are kept "
                    "in the folder for temporary files");
  app.add_flag("--json", settings->json, "Print the counts as JSON");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
