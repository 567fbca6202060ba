// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "command.h"
#include "did_you_mean.h"
#include "gigaray/adapters/mesh_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "gigaray/meshing/mesh_processing.h"
#include "gigaray/meshing/mesh_report.h"
#include "gigaray/meshing/texture.h"
#include "memory_option.h"
#include "numbers.h"
#include "output_option.h"
#include "surface_input.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

/// With what CGAL keeps of them for cleaning and the report.
constexpr double kVertexBytes = 350, kFaceBytes = 250;

struct Settings {
  SurfaceInput input;
  OutputOption output;
  std::string method = "grid";
  double voxel = 0;
  std::size_t most_points = 300'000;
  double trim = PoissonOptions{}.trim;
  MeshCleaning cleaning;
  bool is_textured = false;
  TextureOptions texture;
  MemoryBudget memory;
  bool json = false;
};

/// What a surface over points takes for each of them.
double point_bytes(const Settings& settings) { return settings.method == "poisson" ? 4400 : 2400; }

SurfaceMesh surface_of(const Settings& settings, const SurfaceInput::Opened& input,
                       PointCounts& counts, const RunControl& control) {
  const auto& [views, points] = input;
  if (settings.method == "grid") return grid_mesh(views, points, &counts, control);
  CloudOptions options;
  options.points = points;
  options.voxel = settings.voxel;
  if (settings.voxel == 0) options.most_points = settings.most_points;
  PointCloud cloud;
  counts = build_cloud(
               views, options, [&](const PointCloud& tile) { append(cloud, tile); }, control)
               .pixels;
  control.throw_if_cancelled();
  // How many points there are shows only now; the surfaces of CGAL take most.
  settings.memory.require(kProgramBytes + point_bytes(settings) * double(cloud.size()),
                          fmt::format("a surface over {} points", cloud.size()));
  control.progress("surface", 0, 1);
  SurfaceMesh mesh = settings.method == "poisson"
                         ? poisson_mesh(cloud, {.spacing = 1, .trim = settings.trim}, control)
                         : advancing_front_mesh(cloud, {}, control);
  control.progress("surface", 1, 1);
  return mesh;
}

std::string text_of(const DepthViews& views) {
  return views_text(views.size(), views.cameras.front().width, views.cameras.front().height);
}

/// Bytes until there is a surface.
double bytes_before_surface(const Settings& settings, const DepthViews& views) {
  double pixels = 0;
  for (const Camera& camera : views.cameras)
    pixels = std::max(pixels, double(camera.width) * camera.height);
  const double reading = SurfaceInput::view_bytes(pixels, views.size()) + 200 * pixels;
  // grid: a map of each view that has a part, and a surface of twice the pixels of a view.
  if (settings.method == "grid")
    return kProgramBytes + reading + pixels * (4.0 * views.size() + 2.5 * kVertexBytes);
  // Views see much the same: two points for a pixel of one are more than there are as a rule.
  const double points = std::min(double(settings.most_points), 2 * pixels);
  return kProgramBytes + reading +
         std::max(64 * pixels * views.size(), point_bytes(settings) * points);
}

double bytes_of_surface(const SurfaceMesh& mesh) {
  return kProgramBytes + kVertexBytes * double(mesh.positions.size()) +
         kFaceBytes * double(mesh.faces.size());
}

/// What making and writing a texture takes beside the surface.
double bytes_of_texture(const Settings& settings, const DepthViews& views,
                        const SurfaceMesh& mesh) {
  // The atlas, offsets and masks of it, and its JPEG; an atlas is no larger than all pictures.
  constexpr double kTexel = 9;
  double pixels = 0, most = 0;
  for (const Camera& camera : views.cameras) {
    pixels += 1.1 * camera.width * camera.height;
    most = std::max(most, double(camera.width) * camera.height);
  }
  const double texels =
      std::min(pixels, double(settings.texture.most_px) * settings.texture.most_px);
  return bytes_of_surface(mesh) + SurfaceInput::view_bytes(most, views.size()) + 8 * most +
         (150.0 + views.size()) * double(mesh.faces.size()) +
         400.0 * double(mesh.positions.size()) + kTexel * texels;
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

/// The file of a surface, or the files of a textured one.
class Output {
 public:
  explicit Output(const Settings& settings) : path_(settings.output.path) {
    const OutputRules rules = settings.input.rules(settings.output);
    if (!settings.is_textured)
      plain_.emplace(path_, rules,
                     std::initializer_list<const char*>{".ply", ".obj", ".glb", ".stl"});
    else if (can_have_texture(path_))
      textured_.emplace(path_, rules);
    else
      throw Error(ErrorCode::kInvalidArgument,
                  path_.string() + ": a surface with --texture is written as .glb or .obj");
  }

  void write(const SurfaceMesh& mesh, const SurfaceTexture& texture) {
    if (textured_)
      textured_->write(mesh, texture);
    else
      write_mesh(*plain_, path_, mesh);
  }

  void commit(const RunControl& control) {
    if (textured_)
      textured_->commit(control);
    else
      plain_->commit(control);
  }

 private:
  std::filesystem::path path_;
  std::optional<AtomicFile> plain_;
  std::optional<TexturedMeshOutput> textured_;
};

void run(const Settings& settings, const RunControl& control) {
  Output output(settings);
  const auto begin = std::chrono::steady_clock::now();
  const SurfaceInput::Opened input = settings.input.open(control);
  const DepthViews& views = input.views;
  settings.memory.require(bytes_before_surface(settings, views), text_of(views));
  PointCounts counts;
  MeshCleaned done;
  SurfaceMesh surface =
      settings.input.blamed([&] { return surface_of(settings, input, counts, control); });
  // How large the surface is shows only now; cleaning and the report take most.
  settings.memory.require(bytes_of_surface(surface),
                          fmt::format("a surface of {} vertices", surface.positions.size()));
  const SurfaceMesh mesh = cleaned(std::move(surface), settings.cleaning, &done);
  if (mesh.faces.empty())
    throw Error(
        ErrorCode::kBadInput,
        fmt::format("{}: no surface is left: all pieces have fewer triangles than --least-faces {}",
                    settings.input.result.string(), settings.cleaning.least_faces));
  control.throw_if_cancelled();
  const MeshReport report = report_of(mesh);
  TextureCounts texture_counts;
  SurfaceTexture texture;
  if (settings.is_textured) {
    settings.memory.require(bytes_of_texture(settings, views, mesh),
                            fmt::format("a texture of {} triangles", mesh.faces.size()));
    texture = settings.input.blamed(
        [&] { return texture_of(mesh, views, settings.texture, &texture_counts, control); });
  }
  output.write(mesh, texture);
  output.commit(control);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  if (settings.json) {
    ordered_json root{{"format", "gigaray mesh"},
                      {"version", 1},
                      {"file", path_text(settings.output.path)},
                      {"method", settings.method},
                      {"filters", as_json(counts)},
                      {"pieces_dropped", done.pieces_dropped},
                      {"holes_filled", done.holes_filled},
                      {"mesh", report_json(report)},
                      {"origin", origin_json(mesh.origin)},
                      {"seconds", seconds}};
    if (settings.is_textured) root["texture"] = texture_json(texture, texture_counts);
    fmt::print("{}\n", root.dump(2));
    return;
  }
  print(counts, views.size(), input.points);
  if (done.pieces_dropped > 0)
    fmt::print("small pieces  {} with fewer than {} faces are left out\n", done.pieces_dropped,
               settings.cleaning.least_faces);
  if (settings.cleaning.hole_edges > 0) fmt::print("holes         {} filled\n", done.holes_filled);
  print_report(report);
  if (settings.is_textured) print_texture(texture, texture_counts);
  print_origin(mesh.origin);
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
  app.add_option("--voxel", settings->voxel,
                 "poisson, front: points in a cube of this size become one, scene units")
      ->check(above_zero())
      ->type_name("SIZE");
  app.add_option("--points", settings->most_points,
                 "poisson, front: without --voxel, cubes are so large that no more points are left")
      ->check(CLI::Range(std::size_t(100), std::size_t(100'000'000)))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--trim", settings->trim,
                 "poisson: cut away what is farther from the points, in distances of neighbours; "
                 "0: nothing, the surface is closed")
      ->check(zero_or_more())
      ->type_name("X")
      ->capture_default_str();
  app.add_option("--least-faces", settings->cleaning.least_faces,
                 "Leave out pieces with fewer triangles")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--fill", settings->cleaning.hole_edges, "Fill holes with up to so many edges")
      ->check(CLI::Range(3, 1'000'000))
      ->type_name("EDGES");
  app.add_option("--simplify", settings->cleaning.most_faces,
                 "Collapse edges until so many triangles are left")
      ->check(CLI::Range(std::size_t(4), std::size_t(4'000'000'000)))
      ->type_name("FACES");
  auto* texture = app.add_flag(
      "--texture", settings->is_textured,
      "Colours from the pictures, each triangle from a view that sees it well, with "
      "exposures and seams levelled: in the .glb, or as .mtl and .jpg beside the .obj");
  app.add_option("--texture-size", settings->texture.most_px,
                 "Width and height of the texture at most; pictures are scaled down to fit")
      ->check(CLI::Range(64, 32768))
      ->type_name("PX")
      ->needs(texture)
      ->capture_default_str();
  settings->memory.add_to(app,
                          "some 70 bytes per pixel of all views, and 450 per vertex of the "
                          "surface, whose size shows only when it is there");
  app.add_flag("--json", settings->json, "Print counts and report as JSON");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
