// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>

#include "command.h"
#include "did_you_mean.h"
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
  OutputOption output;
  std::string method = "grid";
  SurfaceRequest request;
  bool json = false;
};

SurfaceMethod method_of(const std::string& name) {
  return name == "poisson" ? SurfaceMethod::kPoisson
         : name == "front" ? SurfaceMethod::kFront
                           : SurfaceMethod::kGrid;
}

ordered_json report_json(const MeshReport& report) {
  const auto list = [](const Eigen::Vector3f& v) { return std::vector<float>{v[0], v[1], v[2]}; };
  return {{"vertices", report.vertices},
          {"faces", report.faces},
          {"components", report.components},
          {"boundary_edges", report.boundary_edges},
          {"boundary_loops", report.boundary_loops},
          {"genus", report.genus},
          {"self_intersections", report.self_intersections},
          {"watertight", report.is_watertight},
          {"area", report.area},
          {"volume", report.volume ? ordered_json(*report.volume) : ordered_json()},
          {"box", {list(report.least), list(report.most)}}};
}

ordered_json texture_json(const SurfaceTexture& texture, const TextureCounts& counts) {
  return {{"size", {texture.picture.width(), texture.picture.height()}},
          {"scale", counts.scale},
          {"views", counts.views},
          {"charts", counts.charts},
          {"largest_gain", counts.largest_gain},
          {"faces_unseen", counts.unseen},
          {"area_unseen", counts.unseen_area}};
}

void print_texture(const SurfaceTexture& texture, const TextureCounts& counts) {
  fmt::print("texture       {} × {} px of {} views in {} charts, gains up to {:.3g}\n",
             texture.picture.width(), texture.picture.height(), counts.views, counts.charts,
             counts.largest_gain);
  if (counts.scale < 1)
    fmt::print("scaled down   to {:.3g} of the pictures, to fit into --texture-size\n",
               counts.scale);
  if (counts.unseen > 0)
    fmt::print("unseen        {} faces, {:.2g} % of the area, have the colours of their vertices\n",
               counts.unseen, 100 * counts.unseen_area);
}

void print_report(const MeshReport& report) {
  fmt::print("surface       {} vertices, {} faces, {} components\n", report.vertices, report.faces,
             report.components);
  fmt::print("shape         {}, genus {}, {} boundary edges in {} loops, {} self-intersections\n",
             report.is_watertight ? "watertight" : "open", report.genus, report.boundary_edges,
             report.boundary_loops, report.self_intersections);
  fmt::print("area          {:.6g}\n", report.area);
  if (report.volume) fmt::print("volume        {:.6g}\n", *report.volume);
  fmt::print("box           {:.4g} {:.4g} {:.4g} … {:.4g} {:.4g} {:.4g}\n", report.least.x(),
             report.least.y(), report.least.z(), report.most.x(), report.most.y(), report.most.z());
}

void run(const Settings& settings, const RunControl& control) {
  SurfaceFile file(settings.output.path, settings.request.is_textured,
                   settings.input.rules(settings.output));
  const auto begin = std::chrono::steady_clock::now();
  const ScenePoints points = settings.input.open(control);
  SurfaceRequest request = settings.request;
  request.method = method_of(settings.method);
  const SceneSurface surface = surface_of(points, request, control);
  file.write(surface);
  file.commit(control);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  if (settings.json) {
    ordered_json root{{"format", "gigaray mesh"},
                      {"version", 1},
                      {"file", path_text(settings.output.path)},
                      {"method", settings.method},
                      {"filters", as_json(surface.pixels)},
                      {"pieces_dropped", surface.cleaned.pieces_dropped},
                      {"holes_filled", surface.cleaned.holes_filled},
                      {"mesh", report_json(surface.report)},
                      {"origin", origin_json(surface.mesh.origin)},
                      {"seconds", seconds}};
    if (request.is_textured)
      root["texture"] = texture_json(surface.texture, surface.texture_counts);
    fmt::print("{}\n", root.dump(2));
    return;
  }
  print(surface.pixels, points.views.size(), points.options);
  if (surface.cleaned.pieces_dropped > 0)
    fmt::print("small pieces  {} with fewer than {} faces are left out\n",
               surface.cleaned.pieces_dropped, request.cleaning.least_faces);
  if (request.cleaning.hole_edges > 0)
    fmt::print("holes         {} filled\n", surface.cleaned.holes_filled);
  print_report(surface.report);
  if (request.is_textured) print_texture(surface.texture, surface.texture_counts);
  print_origin(surface.mesh.origin);
  fmt::print("{}: {} in {:.1f} s\n", settings.output.path.string(), settings.method, seconds);
}

}  // namespace

Run mesh_command(CLI::App& app) {
  app.description("A surface of triangles, coloured, with a report of its shape");
  const auto settings = std::make_shared<Settings>();
  settings->input.declare(app);
  settings->output.add_to(app, "scene.ply, .obj, .glb or .stl", "FILE")->required();
  app.add_option("--method", settings->method,
                 "grid: depth maps triangulated on their pixels, cut where depth jumps; poisson: "
                 "smooth, closes gaps; front: triangles between the points of the cloud")
      ->check(one_of({"grid", "poisson", "front"}))
      ->capture_default_str();
  app.add_option("--voxel", settings->request.voxel,
                 "poisson, front: points in a cube of this size become one, scene units")
      ->check(above_zero())
      ->type_name("SIZE");
  app.add_option("--points", settings->request.most_points,
                 "poisson, front: without --voxel, cubes are so large that no more points are left")
      ->check(CLI::Range(std::size_t(100), std::size_t(100'000'000)))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--trim", settings->request.trim,
                 "poisson: cut away what is farther from the points, in distances of neighbours; "
                 "0: nothing, the surface is closed")
      ->check(zero_or_more())
      ->type_name("X")
      ->capture_default_str();
  app.add_option("--least-faces", settings->request.cleaning.least_faces,
                 "Leave out pieces with fewer triangles")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--fill", settings->request.cleaning.hole_edges,
                 "Fill holes with up to so many edges")
      ->check(CLI::Range(3, 1'000'000))
      ->type_name("EDGES");
  app.add_option("--simplify", settings->request.cleaning.most_faces,
                 "Collapse edges until so many triangles are left")
      ->check(CLI::Range(std::size_t(4), std::size_t(4'000'000'000)))
      ->type_name("FACES");
  auto* texture = app.add_flag(
      "--texture", settings->request.is_textured,
      "Colours from the pictures, each triangle from a view that sees it well, with "
      "exposures and seams levelled: in the .glb, or as .mtl and .jpg beside the .obj");
  app.add_option("--texture-size", settings->request.texture.most_px,
                 "Width and height of the texture at most; pictures are scaled down to fit")
      ->check(CLI::Range(64, 32768))
      ->type_name("PX")
      ->needs(texture)
      ->capture_default_str();
  add_memory_option(app, settings->request.memory,
                    "some 70 bytes per pixel of all views, and 450 per vertex of the "
                    "surface, whose size shows only when it is there");
  app.add_flag("--json", settings->json, "Print counts and report as JSON");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
