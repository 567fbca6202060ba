// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "command.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/workflows/stated_options.h"
#include "gigaray/workflows/view_page.h"
#include "gigaray/workflows/view_server.h"
#include "input_options.h"
#include "output_option.h"
#include "result_info.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kNoLimit = 1 << 20;  // px

struct Settings {
  InputOptions place;  ///< of a result its path alone
  fs::path pictures;   ///< of a result
  double min_confidence = 0;
  OutputOption output;
  int port = 0;
  const CLI::Option* port_option = nullptr;
  ViewSceneRequest scene;
  fs::path compare;
  std::string device;
};

/// What is shown: a scene for the page and what answers its probes.
struct Shown {
  std::string title;
  MakeScene make_scene;
  CurveSource probes;
};

/// With the options that the result was asked for, in the range that it searched.
CurveSource curves_of_result(const Settings& settings, const DepthScene& depth) {
  const fs::path& path = settings.place.path;
  CurveSource source{depth.light_field(), auto_options(), {"opencl", settings.device}};
  if (fs::is_directory(path)) {
    source.options = options_of_file(path);
    // Of a few views the pictures of all had part in the depth.
    if (depth.light_field().kind != LightFieldKind::kUnstructured)
      source.light_field = DepthResult(path).open_input(settings.pictures);
  }
  source.options.views.clear();
  source.options.disparity = depth.range();
  return source;
}

Shown shown_result(const Settings& settings, const RunControl& control) {
  const fs::path& path = settings.place.path;
  const auto depth =
      std::make_shared<DepthScene>(ResultRequest{path, settings.pictures, settings.min_confidence});
  ViewSceneRequest request = settings.scene;
  if (!settings.compare.empty())
    request.compare = std::make_shared<DepthScene>(ResultRequest{settings.compare, {}, 0, false});
  CurveSource probes = curves_of_result(settings, *depth);
  if (!request.is_live) request.curves = probes;
  return {path.filename().string(),
          [depth, request, &control](const TakeSceneFile& take) {
            return view_scene(*depth, request, take, control);
          },
          std::move(probes)};
}

Shown shown_input(const Settings& settings, const RunControl& control) {
  if (!settings.pictures.empty() || settings.min_confidence > 0)
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("--input and --min-confidence go with a result; {} is a light field",
                            settings.place.path.string()));
  if (!settings.compare.empty())
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("--compare goes with a result; {} is a light field",
                            settings.place.path.string()));
  const auto input = std::make_shared<OpenedInput>(open_input(settings.place, control));
  for (const std::string& note : input->light_field.notes) control.message(note);
  return {settings.place.path.filename().string(),
          [input, request = settings.scene, &control](const TakeSceneFile& take) {
            return view_scene(input->light_field, input->request.path.string(), request, take,
                              control);
          },
          {input->light_field, auto_options(), {"opencl", settings.device}}};
}

std::string size_text(std::uintmax_t bytes) {
  return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

void write_page(const Settings& settings, const Shown& shown, const OutputRules& rules,
                const RunControl& control) {
  const fs::path& path = settings.output.path;
  if (path.extension() == ".html" || path.extension() == ".htm") {
    AtomicFile file(path, rules, {".html", ".htm"});
    const std::string page = view_page(shown.title, shown.make_scene);
    file.write(page);
    file.commit(control);
    fmt::print("{}: {}, opens in a browser\n", path.string(), size_text(page.size()));
    return;
  }
  AtomicFolder folder(path, kViewFormat, rules);
  const std::uintmax_t size = write_view_folder(folder.path(), shown.title, shown.make_scene);
  folder.commit(control);
  fmt::print("{}: {}, for a web server\n", path.string(), size_text(size));
}

void run(const Settings& settings, const RunControl& control) {
  if (settings.output.is_given() && settings.port_option->count() > 0)
    throw Error(ErrorCode::kInvalidArgument,
                "--port goes without --output: a page needs no server");
  const bool is_server = !settings.output.is_given();
  Settings asked = settings;
  asked.scene.is_live = is_server;
  // What is shown is small; probes and thresholds are of the pictures as they are.
  asked.scene.max_size = settings.place.max_size > 0 ? settings.place.max_size : kNoLimit;
  asked.place.max_size = 0;
  const bool is_result =
      !kind_of_result(settings.place.path).empty() || settings.place.path.extension() == ".grl";
  const Shown shown = is_result ? shown_result(asked, control) : shown_input(asked, control);
  if (!is_server) {
    const OutputRules rules =
        settings.output.rules({settings.place.path, settings.pictures, settings.compare,
                               settings.scene.truth, settings.scene.cloud, settings.scene.mesh});
    return write_page(settings, shown, rules, control);
  }
  ViewServer server(shown.title, shown.make_scene, shown.probes, settings.port);
  fmt::print("{}\n", server.address());
  std::fflush(stdout);
  control.message("Ctrl-C ends it");
  server.run(control);
}

}  // namespace

Run view_command(CLI::App& app) {
  app.description("Light field, depth, masks, points and the reason for a depth, in one page");
  app.footer(
      "With -o page.html one file that opens in a browser; with -o DIR a folder for a web server; "
      "with neither a\nserver on this machine alone, which also tells why a pixel has its depth.");
  auto settings = std::make_shared<Settings>();
  settings->place.max_size = ViewSceneRequest().max_size;
  settings->place.add_to(app);
  settings->output.add_to(app, "The page, .html, or a folder", "FILE|DIR");
  settings->port_option = app.add_option("--port", settings->port, "Of the server; 0: a free one")
                              ->check(CLI::Range(0, 65535))
                              ->capture_default_str();
  app.add_option("--views", settings->scene.views,
                 "Views whose depth is shown: all, centre, or a list of names, indices and ranges "
                 "(default: nine that stand apart); pictures are those of all views");
  app.add_option("--compare", settings->compare, "Another result of the same light field, to wipe")
      ->type_name("OTHER");
  app.add_option("--truth", settings->scene.truth,
                 "True disparity, of photographs true depth, as `evaluate` takes it, for a picture "
                 "of the errors")
      ->type_name("TRUTH");
  app.add_option("--cloud", settings->scene.cloud, "Points of `gigaray cloud` to show, .ply")
      ->type_name("F.ply");
  app.add_option("--mesh", settings->scene.mesh, "Surface of `gigaray mesh` to show, .glb")
      ->type_name("F.glb");
  app.add_option("--input", settings->pictures,
                 "Of a result: where the pictures are, when they are no more where they were")
      ->type_name("INPUT");
  app.add_option("--min-confidence", settings->min_confidence, "Leave out what is less sure")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("C");
  app.add_option("--device", settings->device, "OpenCL device of the server's probes");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
