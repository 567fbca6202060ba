// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/texture.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "atlas.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "mesh_sight.h"
#include "seams.h"
#include "view_choice.h"
#include "view_gains.h"

namespace gigaray {
namespace {

using Corners = std::vector<std::array<Eigen::Vector2f, 3>>;

constexpr int kLeastPx = 64, kMostPx = 32768;
constexpr std::uint8_t kGrey = 128;

void check(const SurfaceMesh& mesh, const TextureOptions& options) {
  if (options.most_px < kLeastPx || options.most_px > kMostPx)
    throw Error(ErrorCode::kInvalidArgument,
                "most_px is " + std::to_string(options.most_px) + ", not within 64 … 32768");
  if (mesh.faces.empty())
    throw Error(ErrorCode::kInvalidArgument, "a surface without triangles has no texture");
  require_argument(mesh.colours.size() == mesh.positions.size(),
                   "mesh.colours: one for each position is needed");
  for (const auto& face : mesh.faces)
    for (const std::uint32_t corner : face)
      require_argument(corner < mesh.positions.size(),
                       "mesh.faces: name a vertex that is not there");
}

/// Where the corners of the faces are in their views' pictures, px.
Corners corners_in_pictures(const SurfaceMesh& mesh, const std::vector<Camera>& cameras,
                            const std::vector<int>& view_of_face, const std::set<int>& used) {
  Corners corners(mesh.faces.size());
  for (const int view : used) {
    const std::vector<Eigen::Vector3f> places = projected(mesh, cameras[std::size_t(view)]);
    for (std::size_t face = 0; face < corners.size(); ++face)
      if (view_of_face[face] == view)
        for (std::size_t i = 0; i < 3; ++i)
          corners[face][i] = places[mesh.faces[face][i]].head<2>();
  }
  return corners;
}

double area_of(const SurfaceMesh& mesh, std::size_t face) {
  const auto [a, b, c] = mesh.faces[face];
  return 0.5 * double((mesh.positions[b] - mesh.positions[a])
                          .cross(mesh.positions[c] - mesh.positions[a])
                          .norm());
}

void count_unseen(const SurfaceMesh& mesh, const std::vector<int>& view_of_face,
                  TextureCounts& counts) {
  double all = 0, unseen = 0;
  for (std::size_t face = 0; face < view_of_face.size(); ++face) {
    const double area = area_of(mesh, face);
    all += area;
    if (view_of_face[face] >= 0) continue;
    unseen += area;
    ++counts.unseen;
  }
  counts.unseen_area = all > 0 ? unseen / all : 0;
}

}  // namespace

SurfaceTexture texture_of(const SurfaceMesh& mesh, const DepthViews& views,
                          const TextureOptions& options, TextureCounts* counts,
                          const RunControl& control) {
  check(mesh, options);
  const float tolerance = SurfaceTolerance::of(survey(views, control).range).between_views;
  FaceQualities qualities(views.size(), mesh.faces.size());
  ViewGains view_gains(mesh, views.size());
  for (int view = 0; view < views.size(); ++view) {
    control.progress("look", view, views.size());
    const DepthView own = views.read(view);
    const MeshSight sight(mesh, own, tolerance);
    qualities.set(view, sight.qualities());
    if (options.levels_seams) view_gains.look(view, sight, own);
  }
  control.progress("look", 1, 1);

  const auto across = faces_across(mesh);
  const std::vector<int> chosen = choose_views(qualities, across);
  control.throw_if_cancelled();
  std::size_t num_charts = 0;
  const std::vector<std::uint32_t> charts = charts_of(chosen, across, num_charts);
  std::set<int> used(chosen.begin(), chosen.end());
  used.erase(-1);
  const Corners in_pictures = corners_in_pictures(mesh, views.cameras, chosen, used);
  const Atlas atlas = plan_atlas(mesh, views.cameras, chosen, charts, in_pictures, options.most_px);
  std::vector<Eigen::Array3d> gains(views.cameras.size(), Eigen::Array3d::Ones());
  if (options.levels_seams) gains = view_gains.gains();

  SurfaceTexture texture{Image<std::uint8_t>(atlas.width, atlas.height, 3, kGrey),
                         corners_in(atlas, chosen, in_pictures)};
  draw_patches(atlas, texture.picture);
  double done = 0;
  for (const int view : used) {
    control.progress("texture", done++, double(used.size()));
    const DepthView own = views.read(view);
    const ValueTable table = table_of(gains[std::size_t(view)]);
    for (const Crop& crop : atlas.crops)
      if (crop.view == view) draw_crop(atlas, crop, own, table, texture.picture);
  }
  if (options.levels_seams) level_seams(mesh, chosen, texture, control);
  control.progress("texture", 1, 1);

  if (counts) {
    *counts = {};
    counts->views = int(used.size());
    std::set<std::uint32_t> seen;
    for (std::size_t face = 0; face < charts.size(); ++face)
      if (chosen[face] >= 0) seen.insert(charts[face]);
    counts->charts = seen.size();
    counts->scale = atlas.scale;
    count_unseen(mesh, chosen, *counts);
    for (const int view : used)
      for (const double gain : gains[std::size_t(view)])
        counts->largest_gain = std::max({counts->largest_gain, gain, 1 / gain});
  }
  return texture;
}

}  // namespace gigaray
