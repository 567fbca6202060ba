// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/view_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "gigaray/error.h"
#include "gigaray/parallel.h"
#include "witness.h"

namespace gigaray {
namespace {

constexpr double kSameWay = 0.7071;  ///< cosine of 45°
/// An inverse depth of less than so many tolerances says hardly more than "far".
constexpr float kTooFar = 4;

Eigen::Vector3d point_of(const DepthView& view, int u, int v) {
  return view.camera.back_project(u, v, 1 / double(view.inverse_depth(u, v)));
}

/// How the surface runs from (u, v) towards +(du, dv); zero when no neighbour belongs to it.
Eigen::Vector3d tangent(const DepthView& view, int u, int v, int du, int dv, float between_pixels) {
  const FloatMap& map = view.inverse_depth;
  const auto belongs = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < map.width() && y < map.height() &&
           is_one_surface(map(u, v), map(x, y), view.camera.focal_u, between_pixels);
  };
  const bool ahead = belongs(u + du, v + dv), behind = belongs(u - du, v - dv);
  if (!ahead && !behind) return Eigen::Vector3d::Zero();
  return point_of(view, ahead ? u + du : u, ahead ? v + dv : v) -
         point_of(view, behind ? u - du : u, behind ? v - dv : v);
}

/// Views that must see a point when so many should.
int usual_support(int should_see) {
  constexpr int kLeast = 2;
  return std::max(kLeast, int(std::ceil(kSupportShare * should_see - 1e-9)));
}

}  // namespace

PointCounts& PointCounts::operator+=(const PointCounts& other) {
  pixels += other.pixels;
  without_estimate += other.without_estimate;
  unsure += other.unsure;
  too_far += other.too_far;
  contradicted += other.contradicted;
  unconfirmed += other.unconfirmed;
  points += other.points;
  return *this;
}

std::vector<int> witnesses_of(const std::vector<Camera>& cameras, int view, int most) {
  std::vector<int> others;
  for (int i = 0; i < int(cameras.size()); ++i)
    if (i != view && cameras[i].direction().dot(cameras[view].direction()) > kSameWay)
      others.push_back(i);
  const Eigen::Vector3d here = cameras[view].position();
  std::ranges::stable_sort(others, {},
                           [&](int i) { return (cameras[i].position() - here).squaredNorm(); });
  if (int(others.size()) <= most) return others;
  // A third are the nearest, which see the same; a wider base contradicts what is wrong.
  const int nearest = most / 3;
  std::vector<int> chosen(others.begin(), others.begin() + nearest);
  const int rest = int(others.size()) - nearest, wanted = most - nearest;
  for (int i = 0; i < wanted; ++i)
    chosen.push_back(others[nearest + std::int64_t(i + 1) * rest / wanted - 1]);
  return chosen;
}

KeptPixels keep_pixels(const DepthView& view, std::span<const DepthView> witnesses,
                       SurfaceTolerance tolerance, const PointOptions& options) {
  if (options.least_support.value_or(0) < 0 ||
      !(options.least_confidence >= 0 && options.least_confidence <= 1))
    throw Error(ErrorCode::kInvalidArgument,
                "points need a support of 0 or more and a confidence of 0 … 1, not of " +
                    std::to_string(options.least_support.value_or(0)) + " and " +
                    std::to_string(options.least_confidence));
  const int width = view.inverse_depth.width(), height = view.inverse_depth.height();
  KeptPixels kept{Mask(width, height), FloatMap(width, height), {}};
  std::vector<PointCounts> counts(height);
  const auto keep = [&](int u, int v, PointCounts& row) {
    const float w = view.inverse_depth(u, v);
    ++row.pixels;
    if (!(w > 0) || !std::isfinite(w)) return ++row.without_estimate, false;
    if (!view.confidence.empty() && !(view.confidence(u, v) >= options.least_confidence))
      return ++row.unsure, false;
    if (w < kTooFar * tolerance.between_views) return ++row.too_far, false;
    const Eigen::Vector3d point = point_of(view, u, v);
    int sees = 0, through = 0, unclear = 0;
    for (const DepthView& witness : witnesses) {
      const Sight sight = sight_of(witness.camera, witness.inverse_depth, point,
                                   tolerance.between_views, tolerance.between_pixels);
      sees += sight == Sight::kSees;
      through += sight == Sight::kSeesThrough;
      unclear += sight == Sight::kUnclear;
    }
    kept.support(u, v) = float(sees);
    if (through > sees) return ++row.contradicted, false;
    const int wanted = options.least_support.value_or(usual_support(sees + through + unclear));
    if (sees < std::min(wanted, int(witnesses.size()))) return ++row.unconfirmed, false;
    return ++row.points, true;
  };
  parallel_for(
      height,
      [&](int v) {
        for (int u = 0; u < width; ++u) kept.keep(u, v) = keep(u, v, counts[v]);
      },
      [](int) {});
  for (const PointCounts& row : counts) kept.counts += row;
  return kept;
}

FloatMap normals_of(const DepthView& view, SurfaceTolerance tolerance) {
  const FloatMap& map = view.inverse_depth;
  FloatMap normals(map.width(), map.height(), 3, kNoEstimate);
  const Eigen::Vector3d eye = view.camera.position();
  parallel_for(
      map.height(),
      [&](int v) {
        for (int u = 0; u < map.width(); ++u) {
          if (!(map(u, v) > 0)) continue;
          const Eigen::Vector3d to_eye = eye - point_of(view, u, v);
          Eigen::Vector3d normal = tangent(view, u, v, 0, 1, tolerance.between_pixels)
                                       .cross(tangent(view, u, v, 1, 0, tolerance.between_pixels));
          if (!(normal.squaredNorm() > 0)) normal = to_eye;
          if (normal.dot(to_eye) < 0) normal = -normal;
          normal.normalize();
          for (int k = 0; k < 3; ++k) normals(u, v, k) = float(normal[k]);
        }
      },
      [](int) {});
  return normals;
}

PointCloud points_of(const DepthView& view, const KeptPixels& kept, SurfaceTolerance tolerance) {
  const FloatMap normals = normals_of(view, tolerance);
  PointCloud cloud;
  const auto count = std::size_t(kept.counts.points);
  cloud.positions.reserve(count);
  cloud.normals.reserve(count);
  cloud.colours.reserve(count);
  cloud.confidences.reserve(count);
  cloud.supports.reserve(count);
  for (int v = 0; v < kept.keep.height(); ++v)
    for (int u = 0; u < kept.keep.width(); ++u) {
      if (!kept.keep(u, v)) continue;
      cloud.positions.push_back(point_of(view, u, v).cast<float>());
      cloud.normals.emplace_back(normals(u, v, 0), normals(u, v, 1), normals(u, v, 2));
      cloud.colours.push_back(
          {view.picture(u, v, 0), view.picture(u, v, 1), view.picture(u, v, 2)});
      cloud.confidences.push_back(view.confidence.empty() ? 1 : view.confidence(u, v));
      cloud.supports.push_back(kept.support(u, v));
    }
  return cloud;
}

}  // namespace gigaray
