// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "gigaray/adapters/mesh_file.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "surface_memory.h"

namespace gigaray {
namespace {

/// With what CGAL keeps of them for cleaning and the report.
constexpr double kVertexBytes = 350, kFaceBytes = 250;

/// What a surface over points takes for each of them.
double point_bytes(const SurfaceRequest& request) {
  return request.method == SurfaceMethod::kPoisson ? 4400 : 2400;
}

SurfaceMesh raw_surface(const ScenePoints& points, const SurfaceRequest& request,
                        PointCounts& counts, const RunControl& control) {
  if (request.method == SurfaceMethod::kGrid)
    return grid_mesh(points.views, points.options, &counts, control);
  CloudOptions options;
  options.points = points.options;
  options.voxel = request.voxel;
  if (request.voxel == 0) options.most_points = request.most_points;
  PointCloud cloud;
  counts = build_cloud(
               points.views, options, [&](const PointCloud& tile) { append(cloud, tile); }, control)
               .pixels;
  control.throw_if_cancelled();
  // How many points there are shows only now; the surfaces of CGAL take most.
  request.memory.require(kProgramBytes + point_bytes(request) * double(cloud.size()),
                         fmt::format("a surface over {} points", cloud.size()));
  control.progress("surface", 0, 1);
  SurfaceMesh mesh = request.method == SurfaceMethod::kPoisson
                         ? poisson_mesh(cloud, {.spacing = 1, .trim = request.trim}, control)
                         : advancing_front_mesh(cloud, {}, control);
  control.progress("surface", 1, 1);
  return mesh;
}

/// Bytes until there is a surface.
double bytes_before_surface(const SurfaceRequest& request, const DepthViews& views) {
  const double pixels = largest_view(views), reading = reading_bytes(views);
  // grid: a map of each view that has a part, and a surface of twice the pixels of a view.
  if (request.method == SurfaceMethod::kGrid)
    return kProgramBytes + reading + pixels * (4.0 * views.size() + 2.5 * kVertexBytes);
  // Views see much the same: two points for a pixel of one are more than there are as a rule.
  const double points = std::min(double(request.most_points), 2 * pixels);
  return kProgramBytes + reading +
         std::max(64 * pixels * views.size(), point_bytes(request) * points);
}

double bytes_of_surface(const SurfaceMesh& mesh) {
  return kProgramBytes + kVertexBytes * double(mesh.positions.size()) +
         kFaceBytes * double(mesh.faces.size());
}

/// What making and writing a texture takes beside the surface.
double bytes_of_texture(const SurfaceRequest& request, const DepthViews& views,
                        const SurfaceMesh& mesh) {
  // The atlas, offsets and masks of it, and its JPEG; an atlas is no larger than all pictures.
  constexpr double kTexel = 9;
  double pixels = 0, most = 0;
  for (const Camera& camera : views.cameras) {
    pixels += 1.1 * camera.width * camera.height;
    most = std::max(most, double(camera.width) * camera.height);
  }
  const double texels = std::min(pixels, double(request.texture.most_px) * request.texture.most_px);
  return bytes_of_surface(mesh) + kept_bytes(views) + 8 * most +
         (150.0 + views.size()) * double(mesh.faces.size()) +
         400.0 * double(mesh.positions.size()) + kTexel * texels;
}

}  // namespace

SceneSurface surface_of(const ScenePoints& points, const SurfaceRequest& request,
                        const RunControl& control) {
  const DepthViews& views = points.views;
  request.memory.require(bytes_before_surface(request, views), text_of(views));
  SceneSurface result;
  SurfaceMesh surface =
      blamed(points.name, [&] { return raw_surface(points, request, result.pixels, control); });
  // How large the surface is shows only now; cleaning and the report take most.
  request.memory.require(bytes_of_surface(surface),
                         fmt::format("a surface of {} vertices", surface.positions.size()));
  result.mesh = cleaned(std::move(surface), request.cleaning, &result.cleaned);
  if (result.mesh.faces.empty())
    throw Error(
        ErrorCode::kBadInput,
        fmt::format("{}: no surface is left: all pieces have fewer triangles than `least_faces` {}",
                    points.name, request.cleaning.least_faces));
  control.throw_if_cancelled();
  result.report = report_of(result.mesh);
  if (!request.is_textured) return result;
  request.memory.require(bytes_of_texture(request, views, result.mesh),
                         fmt::format("a texture of {} triangles", result.mesh.faces.size()));
  result.texture = blamed(points.name, [&] {
    return texture_of(result.mesh, views, request.texture, &result.texture_counts, control);
  });
  return result;
}

struct SurfaceFile::State {
  std::filesystem::path path;
  std::optional<AtomicFile> plain;
  std::optional<TexturedMeshOutput> textured;
};

SurfaceFile::SurfaceFile(const std::filesystem::path& path, bool is_textured,
                         const OutputRules& rules)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  if (!is_textured)
    state_->plain.emplace(path, rules,
                          std::initializer_list<const char*>{".ply", ".obj", ".glb", ".stl"});
  else if (can_have_texture(path))
    state_->textured.emplace(path, rules);
  else
    throw Error(ErrorCode::kInvalidArgument,
                path.string() + ": a surface with `texture` is written as .glb or .obj");
}

SurfaceFile::~SurfaceFile() = default;

void SurfaceFile::write(const SceneSurface& surface) {
  if (state_->textured)
    state_->textured->write(surface.mesh, surface.texture);
  else
    write_mesh(*state_->plain, state_->path, surface.mesh);
}

void SurfaceFile::commit(const RunControl& control) {
  if (state_->textured)
    state_->textured->commit(control);
  else
    state_->plain->commit(control);
}

}  // namespace gigaray
