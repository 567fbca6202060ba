// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/workflows/masks.h"
#include "numbers.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

struct Settings {
  std::filesystem::path result, input;
  OutputOption output;
  double near = 0, far = 0;
  bool is_interval = false;  ///< are these stated?
  std::vector<int> at;       ///< empty or U V
  std::optional<double> tolerance;
  std::string unit = "auto", views = "all";
  double min_confidence = 0;
  bool soft = false;
  MatteOptions matte;
  std::vector<std::string> formats;
};

/// The interval in scene units, for people; empty where these are not known.
std::string depth_text(const ValueInterval& values, const LightField& geometry) {
  if (!has_metric_depth(geometry)) return {};
  const FloatMap depth =
      depth_from_disparity(FloatMap(2, 1, 1, {values.most, values.least}), geometry);
  const std::string& unit = geometry.rig.unit;
  return fmt::format(", depth {:.4g} … {}{}", depth(0, 0),
                     std::isnan(depth(1, 0)) ? "infinity" : fmt::format("{:.4g}", depth(1, 0)),
                     unit.empty() ? "" : " " + unit);
}

void print_choice(const SceneMasks& masks, const LightField& geometry) {
  const PixelInterval& pixel = *masks.pixel();
  const ValueInterval values = masks.values();
  const bool posed = geometry.kind == LightFieldKind::kUnstructured;
  fmt::print("around {:.4g} at {} {} of {}{}; {}: --near {} --far {}\n", pixel.value(),
             pixel.at().u, pixel.at().v, geometry.views[pixel.view()].name,
             depth_text(values, geometry), posed ? "there the same" : "the same", values.most,
             values.least);
}

MaskRequest request_of(const Settings& settings) {
  MaskRequest request;
  if (settings.is_interval) request.between = MaskRequest::NearFar{settings.near, settings.far};
  if (!settings.at.empty()) request.at = PixelPlace{settings.at[0], settings.at[1]};
  request.tolerance = settings.tolerance;
  request.unit = settings.unit;
  request.soft = settings.soft;
  request.matte = settings.matte;
  return request;
}

void run(const Settings& settings, const RunControl& control) {
  if (!settings.is_interval && settings.at.empty())
    throw Error(ErrorCode::kInvalidArgument,
                "say what belongs to the mask: --at U V, a pixel of it, or --near A --far B");
  AtomicFolder folder(settings.output.path, kSegmentFormat,
                      settings.output.rules({settings.result, settings.input}));
  if (!std::filesystem::exists(settings.result)) DepthResult{settings.result};  // refuses it
  const DepthScene scene({settings.result, settings.input, settings.min_confidence, settings.soft});
  const LightField& geometry = scene.light_field();
  const SceneMasks masks(scene, request_of(settings));
  // exr is the only format there is.
  const int num_views =
      write_masks(masks, settings.views, !settings.formats.empty(), folder.path(), control);
  folder.commit(control);
  control.progress("segment", 1, 1);
  fmt::print("{}: {} {:g} … {:g} in {} views\n", settings.output.path.string(),
             to_string(masks.unit()), masks.values().least, masks.values().most, num_views);
  if (masks.pixel()) print_choice(masks, geometry);
}

void add_interval(CLI::App& app, const std::shared_ptr<Settings>& settings) {
  CLI::Option* at =
      app.add_option("--at", settings->at,
                     "What lies at the depth of this pixel of the view at top level, which is the "
                     "centre view as a rule; 0 0 is its top left corner")
          ->expected(2)
          ->type_name("U V");
  app.add_option("--tolerance", settings->tolerance,
                 "With --at: how far from its depth, px per view step, of photographs with cameras "
                 "a share of the inverse depth (default: as far as the surface at the pixel goes "
                 "without a jump, a tenth of all disparities at most)")
      ->check(above_zero())
      ->needs(at)
      ->type_name("T");
  CLI::Option* near = app.add_option("--near", settings->near, "Nearest value that belongs to it")
                          ->excludes(at)
                          ->type_name("A");
  CLI::Option* far = app.add_option("--far", settings->far, "Farthest value that belongs to it")
                         ->excludes(at)
                         ->type_name("B");
  near->needs(far);
  far->needs(near);
  far->each([settings](const std::string&) { settings->is_interval = true; });
  app.add_option("--unit", settings->unit,
                 "disparity or depth: refuse a pair in the other order; auto: by their order")
      ->check(one_of({"auto", "disparity", "depth"}))
      ->excludes(at)
      ->capture_default_str();
}

}  // namespace

Run segment_command(CLI::App& app) {
  app.description("Masks of what lies in an interval of depth, every view");
  app.footer(
      "--near 0.8 --far -0.2 are disparities, as in disparity.pfm (of photographs with cameras "
      "inverse depths): the near one is larger.\n--near 1.2 --far 3 are distances in scene units, "
      "as in depth.pfm: the near one is less.");
  auto settings = std::make_shared<Settings>();
  app.add_option("RESULT", settings->result, "What `gigaray depth` wrote")
      ->type_name("OUT")
      ->required();
  add_interval(app, settings);
  settings->output
      .add_to(app, "Folder for VIEW/mask.png, that of the centre view also at top level")
      ->required();
  app.add_option("--views", settings->views,
                 "all, centre, or a list of names, indices and ranges: 0,4-6,view_09")
      ->capture_default_str();
  app.add_option("--min-confidence", settings->min_confidence, "Leave out what is less sure")
      ->check(zero_or_more())
      ->type_name("C");
  app.add_flag("--soft", settings->soft,
               "VIEW/matte.png too, 16 bit, with edges that follow the colours of the picture");
  app.add_option("--radius", settings->matte.radius, "With --soft: half the width of the edge, px")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--input", settings->input,
                 "With --soft: where the pictures are, when they are no more where they were")
      ->type_name("INPUT");
  app.add_option("--format", settings->formats, "exr: VIEW/matte.exr or mask.exr too")
      ->check(one_of({"exr"}))
      ->delimiter(',');
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
