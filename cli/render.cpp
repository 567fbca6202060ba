// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "command.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/workflows/render_folder.h"
#include "memory_option.h"
#include "numbers.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

struct Settings {
  std::filesystem::path result, input;
  OutputOption output;
  std::string pose, path, leave_out;
  std::vector<double> refocus;  ///< D [DU DV]
  std::string view = "centre";  ///< to refocus
  double aperture = std::numeric_limits<double>::infinity();
  int frames = 60;
  int sources = 8;
  double min_confidence = 0;
  MemoryBudget memory;
  bool equal_weights = false;
  bool json = false;
};

RenderRequest request_of(const Settings& settings) {
  RenderRequest request{settings.sources, {}};
  request.options.blend.view_dependent = !settings.equal_weights;
  return request;
}

RefocusRequest refocus_of(const Settings& settings) {
  FocalPlane plane{settings.refocus[0]};
  if (settings.refocus.size() == 3) {
    plane.along_u = settings.refocus[1];
    plane.along_v = settings.refocus[2];
  }
  return {settings.view, plane, settings.aperture};
}

/// A view that is rendered without itself, and how alike the two are.
std::pair<RenderReport, std::string> leave_out(const Settings& settings, DepthScene& scene,
                                               const std::filesystem::path& folder,
                                               const RunControl& control) {
  const LeaveOneOut result =
      leave_one_out(scene, settings.leave_out, {settings.sources, {}}, control);
  std::string text;
  const auto add = [&](const char* way, const PictureQuality& quality) {
    text += fmt::format("{:<32}PSNR {:.2f} dB, SSIM {:.4f}\n", way, quality.psnr, quality.ssim);
  };
  add("rendered", result.quality);
  add("without view-dependent weights", result.quality_of_equal_weights);
  add("the two nearest views blended", result.quality_of_nearest_two);
  return {write_left_out(scene, result, settings.leave_out, folder), text};
}

void check(const Settings& settings) {
  const int chosen = int(!settings.pose.empty()) + int(!settings.path.empty()) +
                     int(!settings.leave_out.empty()) + int(!settings.refocus.empty());
  if (chosen != 1)
    throw Error(ErrorCode::kInvalidArgument,
                "say one of --pose, --path, --leave-out and --refocus");
  if (settings.refocus.size() == 2)
    throw Error(ErrorCode::kInvalidArgument, "--refocus takes one number, or three for a plane");
}

void run(const Settings& settings, const RunControl& control) {
  check(settings);
  AtomicFolder folder(settings.output.path, kRenderFormat,
                      settings.output.rules({settings.result, settings.input}));
  DepthScene scene({settings.result, settings.input, settings.min_confidence});
  scene.read_confidence(false);
  // What is made of the sources; --leave-out compares pictures of three ways to render.
  fit_into_memory(scene, settings.refocus.empty() ? settings.sources : 0,
                  settings.leave_out.empty() ? 80 : 600, settings.memory);
  if (!scene.rig().is_metric() && settings.refocus.empty())
    control.message(
        "focal length and view step aren't known: poses off the plane of the cameras "
        "are true up to a projective map (--focal-px and --baseline of `gigaray depth` state "
        "them)");
  const std::string name = settings.output.path.string();
  RenderReport report;
  std::string text;
  if (!settings.pose.empty()) {
    report = write_view(scene, parse_pose(settings.pose, scene), request_of(settings),
                        folder.path(), control);
    text = fmt::format("{}: view.png, {:.2f} % of it seen by a source\n", name, 100 * report.seen);
  } else if (!settings.path.empty()) {
    const auto cameras = cameras_along(parse_path(settings.path, scene), settings.frames);
    report = write_frames(scene, cameras, request_of(settings), folder.path(), control);
    text = fmt::format("{}: {} frames, frame_00000.png …\n", name, cameras.size());
  } else if (!settings.leave_out.empty()) {
    std::tie(report, text) = leave_out(settings, scene, folder.path(), control);
  } else {
    report = write_refocused(scene, refocus_of(settings), folder.path(), control);
    text = fmt::format("{}: view.png\n", name);
  }
  folder.commit(control);
  fmt::print("{}", settings.json ? report.record + "\n" : text);
  control.progress("render", 1, 1);
}

}  // namespace

Run render_command(CLI::App& app) {
  app.description("Novel views, refocused views");
  app.footer(
      "A pose is a view (centre, name or index), S,T (a place between the views of a 3D or 4D "
      "light "
      "field, view steps),\neither of them with +X,Y,Z (moved right, down and ahead, scene units), "
      "or "
      "FILE.json with a camera as in\ngigaray.json of `depth`.");
  auto settings = std::make_shared<Settings>();
  app.add_option("RESULT", settings->result, "What `gigaray depth` wrote, or a .grl file")
      ->type_name("OUT")
      ->required();
  app.add_option("--pose", settings->pose, "One picture from this pose")->type_name("POSE");
  app.add_option("--path", settings->path,
                 "Frames along key poses, with ; between them: \"-4,0;4,0\"")
      ->type_name("POSES");
  app.add_option("--frames", settings->frames, "With --path: number of frames")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--leave-out", settings->leave_out,
                 "Render this view without its picture and depth and compare: PSNR, SSIM")
      ->type_name("VIEW");
  app.add_option("--refocus", settings->refocus,
                 "Synthetic aperture: sharp at disparity D (of photographs with cameras inverse "
                 "depth), or on the plane D + DU · u + DV · v, u and v from the centre of the "
                 "picture")
      ->expected(1, 3)
      ->type_name("D [DU DV]");
  app.add_option("--view", settings->view, "With --refocus: the view")->capture_default_str();
  app.add_option("--aperture", settings->aperture,
                 "With --refocus: views within so many view steps have a part (default: all)")
      ->check(zero_or_more())
      ->type_name("STEPS");
  settings->output.add_to(app, "Folder for the pictures")->required();
  app.add_option("--input", settings->input,
                 "Where the pictures are, when they are no more where they were")
      ->type_name("INPUT");
  app.add_option("--sources", settings->sources, "Views that a novel view is made of, the nearest")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  app.add_option("--min-confidence", settings->min_confidence,
                 "Leave out points that are less sure")
      ->check(zero_or_more())
      ->type_name("C");
  add_memory_option(
      app, settings->memory,
      "some 32 bytes per pixel of each of --sources, and 80 more, with --leave-out 600");
  app.add_flag("--equal-weights", settings->equal_weights,
               "Mix the views that see a point alike, without view-dependent weights");
  app.add_flag("--json", settings->json, "Print gigaray.json to stdout");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
