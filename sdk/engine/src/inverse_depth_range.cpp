// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "edge_matches.h"
#include "gigaray/core/arguments.h"
#include "gigaray/engine/scene_estimates.h"
#include "gigaray/samplers/any_sampler.h"
#include "picture_bands.h"

namespace gigaray {
namespace {

/// Inverse depths at which the middle of a picture is seen by at least half as many other cameras,
/// of those that look a similar way, as where most do.
InverseDepthRange shared_depths(const LightField& light_field, int ref) {
  const std::vector<Camera>& cameras = light_field.cameras;
  const Camera& camera = cameras[ref];
  // To the nearest camera, but for one that stands in the same place.
  constexpr double kSamePlace = 1e-3;  // of the distance to the farthest camera
  double step = std::numeric_limits<double>::infinity(), farthest = 0;
  const auto distance = [&](const Camera& other) {
    return (other.position() - camera.position()).norm();
  };
  for (const Camera& other : cameras) farthest = std::max(farthest, distance(other));
  for (const Camera& other : cameras)
    if (const double d = distance(other); d > kSamePlace * farthest) step = std::min(step, d);
  constexpr int kSteps = 96;
  constexpr double kNearest = 0.2, kFarthest = 1000;  // steps
  constexpr double kLeastCosine = 0.6;
  std::vector<double> inverse;
  std::vector<int> seen;
  for (int i = 0; i < kSteps; ++i) {
    const double z = step * kNearest * std::pow(kFarthest / kNearest, double(i) / (kSteps - 1));
    const Eigen::Vector3d point =
        camera.back_project((camera.width - 1) / 2.0, (camera.height - 1) / 2.0, z);
    int count = 0;
    for (std::size_t j = 0; j < cameras.size(); ++j)
      count += int(j) != ref && cameras[j].direction().dot(camera.direction()) > kLeastCosine &&
               cameras[j].sees(point);
    inverse.push_back(1 / z);
    seen.push_back(count);
  }
  const int most = *std::max_element(seen.begin(), seen.end());
  InverseDepthRange range{0, 0};
  for (int i = 0; i < kSteps; ++i) {
    if (most == 0 || 2 * seen[i] < most) continue;
    range.max = std::max(range.max, inverse[i]);
    range.min = i + 1 == kSteps ? 0 : inverse[i];  // z rises: the last one stays
  }
  return range;
}

/// Points of the scene on strong edges of a view.
std::vector<Eigen::Vector3d> match_points(const LightField& light_field, int ref, SmallViews& small,
                                          const RunControl& control) {
  const UnstructuredSampler all(light_field.cameras);
  // The nearest ones: a coarse search finds most in what looks alike.
  std::vector<int> chosen = all.nearest_partners(ref, 4);
  if (chosen.empty()) return {};
  chosen.insert(chosen.begin(), ref);
  const LightField views = subset(light_field, chosen);
  const UnstructuredSampler sampler(views.cameras);
  const reference::Band band = small.band(chosen, control);
  double travel = 0;
  for (int other = 1; other < views.num_views(); ++other)
    travel = std::max(travel, sampler.travel(0, other));
  constexpr int kMostSteps = 600, kMostEdgePixels = 600;
  const int count = std::clamp(int(2 * travel / double(1 << band.shape.level)), 32, kMostSteps);
  std::vector<Eigen::Vector3d> points;
  for (const PixelMatch& match :
       match_edges(band, sampler, true, {0, 1, count}, control, kMostEdgePixels)) {
    if (!is_reliable(match)) continue;
    const double w = sampler.inverse_depth(0, match.disparity);
    if (w <= 0) continue;
    points.push_back(views.cameras[0].back_project(match.u << band.shape.level,
                                                   match.v << band.shape.level, 1 / w));
  }
  return points;
}

}  // namespace

void estimate_inverse_depths(LightField& light_field, const RunControl& control, bool read_pixels) {
  check(light_field);
  require_argument(light_field.kind == LightFieldKind::kUnstructured,
                   "light_field: has no cameras; inverse depths are those of unstructured ones");
  constexpr std::size_t kMostViewsMatched = 8, kLeastPoints = 30;
  std::vector<Camera>& cameras = light_field.cameras;
  std::vector<int> lacking;
  for (int i = 0; i < light_field.num_views(); ++i) {
    if (cameras[i].inverse_depth) continue;
    lacking.push_back(i);
    const InverseDepthRange bound = shared_depths(light_field, i);
    if (!(bound.max > bound.min))
      throw Error(ErrorCode::kBadInput,
                  "view " + light_field.views[i].name +
                      " shares nothing with any other along its axis; is its pose right?");
    cameras[i].inverse_depth = bound;
  }
  if (!read_pixels) return;

  SmallViews small(light_field);
  std::vector<Eigen::Vector3d> points;
  const std::size_t stride = (lacking.size() + kMostViewsMatched - 1) / kMostViewsMatched;
  for (std::size_t i = 0; i < lacking.size(); i += stride) {
    control.progress("range", double(i), double(lacking.size()));
    const auto more = match_points(light_field, lacking[i], small, control);
    points.insert(points.end(), more.begin(), more.end());
  }
  if (points.size() < kLeastPoints)
    throw Error(ErrorCode::kBadInput,
                "the range of depths can't be estimated: too little in the pictures matches; give "
                "inverse depths with DepthOptions::disparity");
  for (const int i : lacking) {
    std::vector<double> depths;
    for (const Eigen::Vector3d& point : points)
      if (cameras[i].sees(point)) depths.push_back(cameras[i].project(point).z());
    if (const auto range = range_of_depths(std::move(depths))) cameras[i].inverse_depth = range;
  }
}

}  // namespace gigaray
