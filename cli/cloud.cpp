// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/cloud.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "command.h"
#include "gigaray/adapters/cloud_file.h"
#include "numbers.h"
#include "surface_input.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

struct Settings {
  SurfaceInput input;
  CloudOptions cloud;
  double memory_gib = 2;
  std::filesystem::path output;
  bool json = false;
};

void run(const Settings& settings, const RunControl& control) {
  if (settings.output.extension() != ".ply")
    throw Error(ErrorCode::kInvalidArgument,
                settings.output.string() + ": a cloud is written as .ply");
  const auto begin = std::chrono::steady_clock::now();
  const DepthViews views = settings.input.open(control);
  CloudOptions options = settings.cloud;
  options.points = settings.input.points;
  options.memory = std::size_t(settings.memory_gib * double(1 << 30));

  CloudFile file(settings.output);
  const CloudReport report = settings.input.blamed([&] {
    return build_cloud(
        views, options, [&](const PointCloud& tile) { file.add(tile); }, control);
  });
  control.throw_if_cancelled();
  file.commit();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  if (settings.json) {
    const ordered_json root{{"format", "gigaray cloud"},
                            {"version", 1},
                            {"file", settings.output.string()},
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
  print(report.pixels, views.size(), options.points);
  fmt::print("merged        {} points into {}, one per cube of {}{:.4g}\n", report.pixels.points,
             report.merged, settings.cloud.voxel > 0 ? "" : "pixel size, usually ", report.voxel);
  fmt::print("outliers      {} that stand alone\n", report.outliers);
  print_origin(report.origin);
  fmt::print("{}: {} points in {:.1f} s\n", settings.output.string(), report.points, seconds);
}

}  // namespace

Run cloud_command(CLI::App& app) {
  app.description("One coloured, oriented point cloud of all views");
  const auto settings = std::make_shared<Settings>();
  settings->input.declare(app);
  app.add_option("-o,--output", settings->output, "scene.ply")->type_name("FILE")->required();
  app.add_option("--voxel", settings->cloud.voxel,
                 "Points in a cube of this size become one, scene units (default: the distance of "
                 "neighbouring pixels there, in steps of two)")
      ->check(above_zero())
      ->type_name("SIZE");
  app.add_option("--outliers", settings->cloud.outlier_deviations,
                 "Drop points whose neighbours are farther than usual by so many standard "
                 "deviations; 0: none")
      ->check(zero_or_more())
      ->type_name("X")
      ->capture_default_str();
  app.add_option("--memory", settings->memory_gib,
                 "GiB of points in memory; more are kept in the folder for temporary files")
      ->check(CLI::Range(0.001, 1e6))
      ->type_name("GiB")
      ->capture_default_str();
  app.add_flag("--json", settings->json, "Print the counts as JSON");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
