// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "depth_options_cli.h"
#include "did_you_mean.h"
#include "gigaray/workflows/depth.h"
#include "numbers.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

struct Settings {
  DepthRunOptions run;
  std::string views = "all";
  const CLI::Option* views_option = nullptr;
  double min_confidence = 0;
  OutputOption output;
  std::vector<std::string> formats;
  bool json = false;
};

std::set<MapFormat> formats_of(const std::vector<std::string>& names) {
  static const std::map<std::string, MapFormat> kFormats{{"exr", MapFormat::kExr},
                                                         {"npy", MapFormat::kNpy},
                                                         {"png16", MapFormat::kPng16},
                                                         {"colmap", MapFormat::kColmap},
                                                         {"nerfstudio", MapFormat::kNerfstudio}};
  std::set<MapFormat> formats;
  for (const std::string& name : names) formats.insert(kFormats.at(name));
  return formats;
}

void run(const Settings& settings, const RunControl& control) {
  DepthRequest request = settings.run.request();
  request.views = settings.views;
  if (settings.views_option->count() > 0) request.options.views.clear();
  InputRequest input = settings.run.input;
  input.keep_pictures = true;
  input.open.memory_bytes = request.options.memory_bytes;
  const DepthReport report =
      compute_depth_folder(std::move(input), request,
                           {settings.output.path, formats_of(settings.formats),
                            settings.min_confidence, settings.output.replace},
                           control);
  if (settings.json)
    fmt::print("{}\n", report.record);
  else
    fmt::print("{}: {} views in {:.1f} s on {}\n", settings.output.path.string(), report.num_views,
               report.seconds, report.device);
  if (!report.note.empty()) control.message(report.note);
}

/// How closely COLMAP looks at photographs.
void add_quality_option(CLI::App& app, ColmapQuality& quality) {
  const std::map<std::string, ColmapQuality> qualities{{"low", ColmapQuality::kLow},
                                                       {"medium", ColmapQuality::kMedium},
                                                       {"high", ColmapQuality::kHigh}};
  app.add_option_function<std::string>(
         "--quality",
         [&quality, qualities](const std::string& name) { quality = qualities.at(name); },
         "How closely COLMAP looks at photographs for their cameras: low (1000 px, 2048 features), "
         "medium (1600 px, 4096) or high (3200 px, 8192); default: medium")
      ->check(one_of({"low", "medium", "high"}))
      ->option_text("low|medium|high");
}

}  // namespace

Run depth_command(CLI::App& app) {
  app.description("Depth for every view of a light field");
  auto settings = std::make_shared<Settings>();
  settings->run.add_to(app);
  settings->run.add_depth_to(app);
  settings->run.add_table_to(app);
  app.add_flag("--find-cameras", settings->run.input.find_cameras,
               "Find the cameras of a folder of pictures with COLMAP even if they look like a row "
               "(default: when they don't)");
  add_quality_option(app, settings->run.input.quality);
  settings->output.add_to(app, "Folder for the result")->required();
  settings->views_option =
      app.add_option("--views", settings->views,
                     "all, centre, or a list of names, indices and ranges: 0,4-6,view_09")
          ->capture_default_str();
  app.add_option(
         "--min-confidence", settings->min_confidence,
         "Leave out (NaN) what is less sure; with auto the probability of being right within "
         "0.07 px")
      ->check(zero_or_more())
      ->type_name("C");
  app.add_option("--format", settings->formats,
                 "Maps in these formats too: exr, npy, png16; colmap: a dense workspace for "
                 "`colmap stereo_fusion`; nerfstudio: transforms.json with pictures, depth and "
                 "points")
      ->check(one_of({"exr", "npy", "png16", "colmap", "nerfstudio"}))
      ->delimiter(',');
  app.add_flag("--json", settings->json, "Print gigaray.json to stdout");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
