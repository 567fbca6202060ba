// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "command.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/synthetic.h"
#include "gigaray/workflows/synth.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct SynthOptions {
  SyntheticOptions scene;
  OutputOption out;
  int views = 17;
  std::string grid;  ///< "9x9"; empty: a row of `views`
  std::pair<double, double> disparity{-1, 1};
  std::optional<SyntheticPath::Shape> shape;  ///< photographs along a path
  SyntheticPath path;
};

/// The numbers of "9x7".
std::pair<int, int> parse_grid(const std::string& text) {
  int across = 0, down = 0;
  char separator = 0, rest = 0;
  std::istringstream stream(text);
  if (!(stream >> across >> separator >> down) || separator != 'x' || stream >> rest)
    throw Error(ErrorCode::kInvalidArgument,
                "--grid is '" + text + "'; write views across x views down, for example 9x9");
  return {across, down};
}

void synthesise(SynthOptions options, const RunControl& control) {
  SyntheticOptions& scene = options.scene;
  scene.views_s = options.views;
  if (options.shape) {
    options.path.shape = *options.shape;
    const int photographs = write_synthetic_photographs(options.out.path, scene, options.path,
                                                        options.out.rules({}), control);
    fmt::print("{}: {} photographs of {} × {} px; their cameras in {}, exact depth in {}\n",
               options.out.path.string(), photographs, scene.width, scene.height,
               (options.out.path / "sparse" / "0").string(), (options.out.path / "truth").string());
    return;
  }
  if (!options.grid.empty()) std::tie(scene.views_s, scene.views_t) = parse_grid(options.grid);
  scene.disparity = {options.disparity.first, options.disparity.second};
  const LightField light_field =
      write_synthetic_light_field(options.out.path, scene, options.out.rules({}), control);
  fmt::print("{}: {} views of {} × {} px, disparity {:g} … {:g}; exact disparity in {}\n",
             options.out.path.string(), light_field.num_views(), scene.width, scene.height,
             scene.disparity.min, scene.disparity.max, (options.out.path / "truth").string());
}

/// Photographs from anywhere instead of parallel views.
void add_path(CLI::App& app, SynthOptions& options, CLI::Option& grid, CLI::Option& disparity) {
  using Shape = SyntheticPath::Shape;
  const std::map<std::string, Shape> shapes = {
      {"line", Shape::kLine}, {"arc", Shape::kArc}, {"walk", Shape::kWalk}};
  auto* path =
      app.add_option_function<std::string>(
             "--path",
             [&options, shapes](const std::string& name) { options.shape = shapes.at(name); },
             "Photographs with exact depth and a COLMAP model, taken along a "
             "line, an arc or a walk; the scene is 1 to 2.5 m away, room and figure 1 to 4 m")
          ->check(one_of({"line", "arc", "walk"}))
          ->option_text("line|arc|walk")
          ->excludes(&grid)
          ->excludes(&disparity);
  const auto add = [&](const char* name, double& value, const char* help) {
    return app.add_option(name, value, help)->capture_default_str()->needs(path);
  };
  auto* extent = add("--extent", options.path.extent, "Length of the path, m");
  add("--step", options.path.step,
      "Angle between neighbouring cameras seen from the middle of the scene, degrees, up to 20: "
      "the "
      "path goes around it, for an arc or a walk")
      ->excludes(extent);
  add("--spacing-noise", options.path.spacing_noise,
      "Standard deviation of the steps along it, of the mean step");
  add("--off-line", options.path.off_line, "Standard deviation of the places beside it, m");
  add("--rotation-noise", options.path.rotation_noise,
      "Standard deviation of the camera's rotations, degrees about each axis");
  add("--exposure-noise", options.path.exposure_noise,
      "Standard deviation of the exposure, stops: a gain in linear light (encoded by 2.2)");
  add("--distortion", options.path.distortion, "k1 of a SIMPLE_RADIAL lens");
}

}  // namespace

Run synth_command(CLI::App& app) {
  app.description(
      "Render a synthetic light field with exact disparity for every view, or photographs with "
      "exact depth");
  auto options = std::make_shared<SynthOptions>();
  SyntheticOptions& scene = options->scene;
  app.add_option("SCENE", scene.scene,
                 fmt::format("One of {}", fmt::join(synthetic_scene_names(), ", ")))
      ->check(one_of(synthetic_scene_names()).description(""))
      ->required();
  options->out.add_to(app, "Folder to write")->required();
  app.add_option("--width", scene.width, "px")->capture_default_str();
  app.add_option("--height", scene.height, "px")->capture_default_str();
  auto* views = app.add_option("--views", options->views, "Views in a row: a 3D light field")
                    ->capture_default_str();
  auto* grid =
      app.add_option("--grid", options->grid, "Views across x down, as in 9x9: a 4D light field")
          ->excludes(views)
          ->type_name("SxT");
  auto* disparity = app.add_option("--disparity", options->disparity,
                                   "Of the farthest and the nearest surface, px per view step")
                        ->type_name("MIN MAX")
                        ->capture_default_str();
  add_path(app, *options, *grid, *disparity);
  app.add_option("--noise", scene.noise, "Standard deviation of sensor noise, of a full range of 1")
      ->capture_default_str();
  app.add_option("--outliers", scene.outliers,
                 "Share of views in which somebody walks through the picture, 0 to 1")
      ->capture_default_str();
  app.add_option("--seed", scene.seed, "The same seed gives the same pixels")
      ->check([](const std::string& text) {
        // The parser would take a negative number for a huge one.
        return text.starts_with('-') ? "is " + text + "; it must be 0 or more" : std::string();
      })
      ->capture_default_str();
  app.add_option("--bit-depth", scene.bit_depth, "8 or 16")->capture_default_str();
  app.add_option("--samples", scene.samples, "Rays per pixel and axis at edges")
      ->capture_default_str();
  return [options](const RunControl& control) { synthesise(*options, control); };
}

}  // namespace gigaray::cli
