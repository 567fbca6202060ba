// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "cameras.h"
#include "command.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/picture_quality.h"
#include "gigaray/refocus.h"
#include "memory_option.h"
#include "numbers.h"
#include "output_option.h"
#include "render_scene.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kRenderFormat = "gigaray render";

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

/// A rendered picture in the output folder.
struct Frame {
  std::string file;
  Camera camera;
  double seen = 1;  ///< share of pixels that a source sees
};

ordered_json to_json(const std::vector<Frame>& frames) {
  ordered_json list = ordered_json::array();
  for (const Frame& frame : frames)
    list.push_back(
        {{"file", frame.file}, {"camera", camera_json(frame.camera)}, {"seen", frame.seen}});
  return list;
}

double share(const Mask& mask) {
  return double(std::count(mask.begin(), mask.end(), 1)) / double(mask.size());
}

NovelViewOptions options_of(const Settings& settings) {
  NovelViewOptions options;
  options.blend.view_dependent = !settings.equal_weights;
  return options;
}

class Output {
 public:
  explicit Output(const Settings& settings)
      : folder_(settings.output.path, kRenderFormat,
                settings.output.rules({settings.result, settings.input})) {}

  void set_bit_depth(int bit_depth) { bit_depth_ = bit_depth; }

  void write(const std::string& name, const Image<std::uint16_t>& picture) {
    write_png(folder_.path() / name, picture, bit_depth_);
  }
  void write(const std::string& name, const FloatMap& map) {
    write_pfm(folder_.path() / name, map);
  }
  void commit(const Settings& settings, ordered_json about, const RunControl& control) {
    ordered_json root{{"format", kRenderFormat},
                      {"version", 1},
                      {"result", path_text(std::filesystem::absolute(settings.result))}};
    root.update(about);
    text_ = root.dump(2, ' ', false, ordered_json::error_handler_t::replace);
    write_file_atomically(folder_.path() / "gigaray.json", text_ + "\n");
    folder_.commit(control);
  }
  const std::string& text() const { return text_; }

 private:
  AtomicFolder folder_;
  int bit_depth_ = 8;
  std::string text_;
};

/// The views on the way along key frames, as many as asked for.
std::vector<Camera> cameras_along(const std::vector<Camera>& keys, int frames) {
  std::vector<Camera> cameras;
  for (int i = 0; i < frames; ++i) {
    const double at = frames > 1 ? double(i) * double(keys.size() - 1) / (frames - 1) : 0;
    const auto key = std::min(std::size_t(at), keys.size() - (keys.size() > 1 ? 2 : 1));
    cameras.push_back(keys.size() > 1 ? between(keys[key], keys[key + 1], at - double(key))
                                      : keys[0]);
  }
  return cameras;
}

std::vector<Camera> parse_path(const std::string& text, const RenderScene& scene) {
  std::vector<Camera> keys;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) keys.push_back(parse_pose(part, scene));
  if (keys.size() < 2)
    throw Error(ErrorCode::kInvalidArgument,
                "--path needs two key frames or more, with ; between them");
  return keys;
}

void render_pose(const Settings& settings, RenderScene& scene, Output& output,
                 const RunControl& control) {
  const Camera camera = parse_pose(settings.pose, scene);
  control.progress("render", 0, 1);
  const NovelView view = scene.render(camera, settings.sources, -1, options_of(settings), control);
  output.write("view.png", view.picture);
  output.write("inverse_depth.pfm", view.inverse_depth);
  const Frame frame{"view.png", camera, share(view.seen)};
  output.commit(settings, {{"frames", to_json({frame})}}, control);
  if (settings.json)
    fmt::print("{}\n", output.text());
  else
    fmt::print("{}: view.png, {:.2f} % of it seen by a source\n", settings.output.path.string(),
               100 * frame.seen);
}

void render_path(const Settings& settings, RenderScene& scene, Output& output,
                 const RunControl& control) {
  const std::vector<Camera> cameras =
      cameras_along(parse_path(settings.path, scene), settings.frames);
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    control.progress("render", double(i), double(cameras.size()));
    const NovelView view =
        scene.render(cameras[i], settings.sources, -1, options_of(settings), control);
    frames.push_back({fmt::format("frame_{:05}.png", i), cameras[i], share(view.seen)});
    output.write(frames.back().file, view.picture);
  }
  output.commit(settings, {{"frames", to_json(frames)}}, control);
  if (settings.json)
    fmt::print("{}\n", output.text());
  else
    fmt::print("{}: {} frames, frame_00000.png …\n", settings.output.path.string(), frames.size());
}

/// The two nearest views, the nearer one counting more; no depth.
Image<std::uint16_t> blend_of_nearest(RenderScene& scene, const Camera& camera, int exclude) {
  const std::vector<int> two = nearest_cameras(scene.rig().cameras(), camera, 2, exclude);
  const SourceView& a = scene.source(two.front());
  const double to_a = (a.camera.position() - camera.position()).norm();
  const SourceView& b = scene.source(two.back());
  const double to_b = (b.camera.position() - camera.position()).norm();
  const double part = to_a + to_b > 0 ? to_a / (to_a + to_b) : 0;
  Image<std::uint16_t> picture(camera.width, camera.height, 3);
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u)
      for (int c = 0; c < 3; ++c) {
        const auto of = [&](const Image<std::uint16_t>& from) {
          return double(from(std::min(u, from.width() - 1), std::min(v, from.height() - 1), c));
        };
        picture(u, v, c) =
            std::uint16_t(std::lround((1 - part) * of(a.picture) + part * of(b.picture)));
      }
  return picture;
}

/// Renders a view that is there without it and says how alike the two are.
void leave_one_out(const Settings& settings, RenderScene& scene, Output& output,
                   const RunControl& control) {
  const int index = scene.find(settings.leave_out);
  RealView real;
  int exclude = -1;
  if (index < 0 &&
      std::any_of(scene.light_field().left_out.begin(), scene.light_field().left_out.end(),
                  [&](const View& view) { return view.name == settings.leave_out; })) {
    real = scene.left_out(settings.leave_out);
  } else {
    exclude = parse_view(settings.leave_out, scene.light_field());
    real = real_view(scene.light_field(), exclude, scene.rig().camera(exclude));
    control.message(
        "its picture had a part in the depth of the others; `depth --without` keeps it out");
  }
  const int bit_depth = scene.light_field().pixels->bit_depth();
  control.progress("render", 0, 1);
  const NovelView view =
      scene.render(real.camera, settings.sources, exclude, NovelViewOptions(), control);
  NovelViewOptions equal;
  equal.blend.view_dependent = false;
  const NovelView alike = scene.render(real.camera, settings.sources, exclude, equal, control);
  const Image<std::uint16_t> blend = blend_of_nearest(scene, real.camera, exclude);
  output.write("view.png", view.picture);
  output.write("real.png", real.picture);
  output.write("equal_weights.png", alike.picture);
  output.write("nearest_two.png", blend);
  output.write("inverse_depth.pfm", view.inverse_depth);
  const auto quality = [&](const Image<std::uint16_t>& picture) {
    return picture_quality(picture, real.picture, bit_depth, real.shown);
  };
  struct Score {
    const char* name;
    const char* text;
    PictureQuality quality;
  };
  const Score scores[] = {
      {"rendered", "rendered", quality(view.picture)},
      {"equal_weights", "without view-dependent weights", quality(alike.picture)},
      {"nearest_two", "the two nearest views blended", quality(blend)}};
  ordered_json qualities = ordered_json::object();
  for (const Score& score : scores)
    qualities[score.name] = {{"psnr", score.quality.psnr}, {"ssim", score.quality.ssim}};
  output.commit(settings,
                {{"left_out", settings.leave_out},
                 {"took_part_in_depth", exclude >= 0},
                 {"seen", share(view.seen)},
                 {"quality", qualities}},
                control);
  if (settings.json) {
    fmt::print("{}\n", output.text());
    return;
  }
  for (const Score& score : scores)
    fmt::print("{:<32}PSNR {:.2f} dB, SSIM {:.4f}\n", score.text, score.quality.psnr,
               score.quality.ssim);
}

void render_refocused(const Settings& settings, RenderScene& scene, Output& output,
                      const RunControl& control) {
  const int view = parse_view(settings.view, scene.light_field());
  FocalPlane plane{settings.refocus[0]};
  if (settings.refocus.size() == 3) {
    plane.along_u = settings.refocus[1];
    plane.along_v = settings.refocus[2];
  }
  output.write("view.png", refocus(scene.light_field(), view, plane, settings.aperture, control));
  output.commit(settings,
                {{"view", scene.light_field().views[view].name},
                 {"focus", {plane.value, plane.along_u, plane.along_v}}},
                control);
  if (settings.json)
    fmt::print("{}\n", output.text());
  else
    fmt::print("{}: view.png\n", settings.output.path.string());
}

/// Refuses what doesn't fit, and keeps as many views as do.
void fit_into_memory(const Settings& settings, RenderScene& scene) {
  const LightField& light_field = scene.light_field();
  const double pixels = double(light_field.width) * light_field.height;
  const int sources = std::min(settings.sources, light_field.num_views());
  // Copies of the sources, a map of what each gives, and what is made of them; --leave-out compares
  // pictures of three ways to render.
  const double made = pixels * (settings.leave_out.empty() ? 80 : 600);
  const double work =
      made + (settings.refocus.empty() ? sources * (scene.source_bytes() + scene.map_bytes()) : 0);
  const double least =
      kProgramBytes + work + (settings.refocus.empty() ? sources * scene.source_bytes() : 0);
  settings.memory.require(
      least, views_text(light_field.num_views(), light_field.width, light_field.height));
  scene.keep(std::size_t(
      std::clamp(sources + (settings.memory.bytes() - least) / scene.source_bytes(), 1.0, 24.0)));
}

void run(const Settings& settings, const RunControl& control) {
  const int chosen = int(!settings.pose.empty()) + int(!settings.path.empty()) +
                     int(!settings.leave_out.empty()) + int(!settings.refocus.empty());
  if (chosen != 1)
    throw Error(ErrorCode::kInvalidArgument,
                "say one of --pose, --path, --leave-out and --refocus");
  if (settings.refocus.size() == 2)
    throw Error(ErrorCode::kInvalidArgument, "--refocus takes one number, or three for a plane");
  Output output(settings);
  RenderScene scene(settings.result, settings.input, settings.min_confidence);
  output.set_bit_depth(scene.light_field().pixels->bit_depth());
  fit_into_memory(settings, scene);
  if (!scene.rig().is_metric() && settings.refocus.empty())
    control.message(
        "focal length and view step aren't known: poses off the plane of the cameras "
        "are true up to a projective map (--focal-px and --baseline of `gigaray depth` state "
        "them)");
  if (!settings.pose.empty()) render_pose(settings, scene, output, control);
  if (!settings.path.empty()) render_path(settings, scene, output, control);
  if (!settings.leave_out.empty()) leave_one_out(settings, scene, output, control);
  if (!settings.refocus.empty()) render_refocused(settings, scene, output, control);
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
  settings->memory.add_to(
      app, "some 32 bytes per pixel of each of --sources, and 80 more, with --leave-out 600");
  app.add_flag("--equal-weights", settings->equal_weights,
               "Mix the views that see a point alike, without view-dependent weights");
  app.add_flag("--json", settings->json, "Print gigaray.json to stdout");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
