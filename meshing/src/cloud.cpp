// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/cloud.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "plain_ground.h"
#include "thin_cloud.h"
#include "tile_store.h"

namespace gigaray {
namespace {

/// Side and halo of a tile in voxels. PCL numbers the voxels of a tile with 31 bits.
constexpr int kTileSide = 512, kTileHalo = 6;

void check(const CloudOptions& options) {
  const auto bad = [](const std::string& what) { throw Error(ErrorCode::kInvalidArgument, what); };
  if (!(options.voxel >= 0) || !std::isfinite(options.voxel))
    bad("the voxels of a cloud have a side above 0, not " + std::to_string(options.voxel));
  if (!(options.outlier_deviations >= 0))
    bad("outliers are farther by a number of deviations of 0 or more, not " +
        std::to_string(options.outlier_deviations));
  if (options.neighbours < 3)
    bad("a point needs 3 neighbours or more, not " + std::to_string(options.neighbours));
}

double voxel_of(double voxel, int level) { return std::ldexp(voxel, level); }

/// A coordinate beyond 2^30 voxels has no place in a grid, and no precision.
void check_extent(const PointCloud& cloud, double voxel, std::span<const int> levels) {
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!(double(cloud.positions[i].cwiseAbs().maxCoeff()) <
          voxel_of(voxel, levels[i]) * (1 << 30)))
      throw Error(ErrorCode::kInvalidArgument, "voxels with a side of " + std::to_string(voxel) +
                                                   " are too small for a scene of this size");
}

/// Levels of the voxels that come nearest to the distance of neighbouring pixels at each point: a
/// voxel has 2^level times the side of level 0.
std::vector<int> levels_of(const PointCloud& cloud, const Camera& camera, double voxel) {
  constexpr double kMost = 60;  // far beyond any scene
  std::vector<int> levels;
  levels.reserve(cloud.size());
  for (const Eigen::Vector3f& position : cloud.positions) {
    const double depth = camera.project(position.cast<double>()).z();
    const double level = std::round(std::log2(depth / camera.focal_u / voxel));
    levels.push_back(int(std::clamp(level, -kMost, kMost)));
  }
  return levels;
}

/// Appends points i of the tile for which keep(i).
template <class Keep>
PointCloud chosen(const PointCloud& tile, const Eigen::Vector3d& origin, Keep keep) {
  PointCloud cloud;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    if (!keep(i)) continue;
    cloud.positions.push_back((tile.positions[i].cast<double>() + origin).cast<float>());
    cloud.normals.push_back(tile.normals[i]);
    cloud.colours.push_back(tile.colours[i]);
    cloud.confidences.push_back(tile.confidences[i]);
    cloud.supports.push_back(tile.supports[i]);
  }
  return cloud;
}

TileStore store_for(double voxel, std::size_t memory) {
  return TileStore(kTileSide * voxel, kTileHalo * voxel, memory);
}

/// Points of all views that are kept, into the store.
void collect(const DepthViews& views, const CloudOptions& options, SurfaceTolerance tolerance,
             TileStore& store, CloudReport& report, const RunControl& control) {
  for (int view = 0; view < views.size(); ++view) {
    control.throw_if_cancelled();
    control.progress("points", view, views.size());
    std::vector<DepthView> witnesses;
    for (const int witness : witnesses_of(views.cameras, view, options.points.most_witnesses))
      witnesses.push_back(views.read(witness));
    DepthView own = views.read(view);
    KeptPixels kept = keep_pixels(own, witnesses, tolerance, options.points);
    own.inverse_depth = std::move(kept.inverse_depth);
    report.pixels += kept.counts;
    const PointCloud points = points_of(own, kept, tolerance);
    const std::vector<int> levels = options.voxel > 0 ? std::vector<int>(points.size(), 0)
                                                      : levels_of(points, own.camera, report.voxel);
    check_extent(points, report.voxel, levels);
    store.add(points, levels);
  }
  control.progress("points", 1, 1);
}

/// Merges the points of every tile and hands them on, with their halo: work(points, tile).
template <class Work>
void merge_tiles(TileStore& store, double voxel, const RunControl& control, Work work) {
  const std::vector<TileIndex> tiles = store.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    control.throw_if_cancelled();
    control.progress("merge", double(i), double(tiles.size()));
    work(merge_points(store.take(tiles[i]), voxel_of(voxel, tiles[i].level)), tiles[i]);
  }
}

/// The merged points in voxels so large that there are no more than asked for.
void thin(TileStore& store, const CloudOptions& options, double& voxel, const RunControl& control) {
  for (;;) {
    PointCloud all;
    std::vector<int> levels;
    const auto gather = [&](const PointCloud& points, const TileIndex& tile) {
      append(all, chosen(points, store.origin(tile),
                         [&](std::size_t k) { return store.is_own(tile, points.positions[k]); }));
      levels.resize(all.size(), tile.level);
    };
    merge_tiles(store, voxel, control, gather);
    // Points on a surface: half as many when the voxel has twice the area.
    const double excess = double(all.size()) / double(options.most_points);
    if (excess > 1) voxel *= 1.05 * std::sqrt(excess);
    store = store_for(voxel, options.memory);
    store.add(all, levels);
    if (excess <= 1) return;
  }
}

}  // namespace

CloudReport build_cloud(const DepthViews& all, const CloudOptions& options,
                        const std::function<void(const PointCloud&)>& take,
                        const RunControl& control) {
  check(options);
  require_argument(bool(take), "take: is empty");
  const DepthViews in_scene = without_plain_ground(all, options.points.keeps_plain_ground, control);
  const Survey seen = survey(in_scene, control);
  const auto tolerance = SurfaceTolerance::of(seen.range);
  const auto [views, frame_origin] = nearby(in_scene, seen.spacing);
  CloudReport report;
  report.origin = frame_origin;
  report.voxel = options.voxel > 0 ? options.voxel : seen.spacing;
  TileStore store = store_for(report.voxel, options.memory);
  collect(views, options, tolerance, store, report, control);
  report.bytes_on_disk = store.bytes_on_disk();
  if (options.most_points > 0) thin(store, options, report.voxel, control);

  report.tiles = int(store.tiles().size());
  const auto finish = [&](PointCloud points, const TileIndex& tile) {
    smooth_normals(points, options.neighbours);
    std::vector<std::uint8_t> in_company(points.size(), 1);
    if (options.outlier_deviations > 0)
      in_company = points_in_company(points, options.neighbours, options.outlier_deviations);
    std::uint64_t own = 0;
    PointCloud cloud = chosen(points, store.origin(tile), [&](std::size_t k) {
      if (!store.is_own(tile, points.positions[k])) return false;
      ++own;
      return in_company[k] != 0;
    });
    cloud.origin = report.origin;
    report.merged += own;
    report.outliers += own - cloud.size();
    report.points += cloud.size();
    if (!cloud.empty()) take(cloud);
  };
  merge_tiles(store, report.voxel, control, finish);
  if (report.points == 0)
    throw Error(ErrorCode::kBadInput, "no point is left: " + std::to_string(report.pixels.points) +
                                          " pixels are sure and confirmed by other views");
  control.progress("merge", 1, 1);
  return report;
}

}  // namespace gigaray
