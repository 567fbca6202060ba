// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <utility>

#include "gigaray/adapters/cloud_file.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/workflows/cameras.h"
#include "gigaray/workflows/view_list.h"
#include "surface_memory.h"

namespace gigaray {
namespace {

/// Bytes of a run, and of one that keeps its points in a file as far as it can.
struct Needs {
  double all, least;
};

Needs needs_of(const DepthViews& views) {
  const double pixels = largest_view(views), reading = reading_bytes(views);
  // Points of all views, in vectors that grow; those of a tile, which is no larger than 512 voxels.
  constexpr double kPoint = 52, kTilePoint = 40, kTile = 512.0 * 512;
  const double least_store = 32 << 20;
  return {
      kProgramBytes + reading + kPoint * pixels * views.size(),
      kProgramBytes + reading + least_store + kTilePoint * std::min(pixels, kTile) * views.size()};
}

}  // namespace

double largest_view(const DepthViews& views) {
  double pixels = 0;
  for (const Camera& camera : views.cameras)
    pixels = std::max(pixels, double(camera.width) * camera.height);
  return pixels;
}

double kept_bytes(const DepthViews& views) {
  constexpr double kPixel = 2 * sizeof(float) + 3 * sizeof(std::uint16_t);
  constexpr double kMostKept = 24;
  return kPixel * largest_view(views) * std::min<double>(views.size(), kMostKept);
}

double reading_bytes(const DepthViews& views) {
  return kept_bytes(views) + 200 * largest_view(views);
}

std::string text_of(const DepthViews& views) {
  return views_text(views.size(), views.cameras.front().width, views.cameras.front().height);
}

ScenePoints points_of_scene(std::shared_ptr<DepthScene> scene, const PointsRequest& request,
                            const RunControl& control) {
  const LightField& light_field = scene->light_field();
  std::vector<int> chosen = parse_views(request.views, light_field);
  if (chosen.empty()) chosen = scene->views();
  if (!scene->rig().is_metric())
    control.message(
        "focal length and view step are not known: the scene keeps straight lines but not angles "
        "(`focal_px` and `baseline` of `gigaray depth` state them)");
  if (const std::string note = note_on_scale(light_field); !note.empty()) control.message(note);
  ScenePoints points{{}, request.options, scene->name()};
  if (light_field.kind == LightFieldKind::kUnstructured)
    points.options.least_confidence = kPosedConfidence;
  if (request.min_confidence) points.options.least_confidence = *request.min_confidence;
  for (const int view : chosen) points.views.cameras.push_back(scene->rig().camera(view));
  points.views.read = [scene = std::move(scene), chosen = std::move(chosen)](int view) {
    return scene->view(chosen[std::size_t(view)]);
  };
  return points;
}

CloudReport cloud_of(const ScenePoints& points, const CloudRequest& request,
                     const std::function<void(const PointCloud& tile)>& take,
                     const RunControl& control) {
  const Needs needs = needs_of(points.views);
  request.memory.require(std::min(needs.all, needs.least), text_of(points.views));
  CloudOptions options = request.cloud;
  options.points = points.options;
  // Vectors that grow take up to twice what is in them.
  if (request.memory.bytes() < needs.all)
    options.memory = std::size_t((32 << 20) + (request.memory.bytes() - needs.least) / 2);
  return blamed(points.name, [&] { return build_cloud(points.views, options, take, control); });
}

CloudReport write_cloud(const std::filesystem::path& path, std::shared_ptr<DepthScene> scene,
                        const CloudRequest& request, const RunControl& control) {
  CloudFile file(AtomicFile(path, OutputRules(), {".ply", ".pcd"}),
                 path.extension() == ".pcd" ? CloudFormat::kPcd : CloudFormat::kPly);
  const ScenePoints points = points_of_scene(std::move(scene), request.points, control);
  const CloudReport report = cloud_of(
      points, request, [&](const PointCloud& tile) { file.add(tile); }, control);
  file.commit(control);
  return report;
}

}  // namespace gigaray
