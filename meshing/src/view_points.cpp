// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/view_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "gigaray/core/parallel.h"
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

/// How far a point in the middle of the view moves in the witness's picture, px per inverse depth.
double parallax(const Camera& view, const Camera& witness, double inverse_depth) {
  constexpr double kStep = 1e-3;
  const auto place = [&](double w) {
    return witness.project(view.back_project(0.5 * view.width, 0.5 * view.height, 1 / w));
  };
  const Eigen::Vector3d from = place(inverse_depth), to = place((1 + kStep) * inverse_depth);
  return from.z() > 0 && to.z() > 0 ? (to - from).head<2>().norm() / (kStep * inverse_depth) : 0;
}

/// The difference of inverse depths that is a pixel in the picture of the witness that tells most.
float finest_difference(const DepthView& view, std::span<const DepthView> witnesses) {
  std::vector<float> known;
  for (const float w : view.inverse_depth)
    if (w > 0 && std::isfinite(w)) known.push_back(w);
  if (known.empty()) return 0;
  const auto middle = known.begin() + std::ptrdiff_t(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  double most = 0;
  for (const DepthView& witness : witnesses)
    most = std::max(most, parallax(view.camera, witness.camera, *middle));
  return most > 0 ? float(1 / most) : std::numeric_limits<float>::infinity();
}

/// What witnesses say of a point.
class Hearing {
 public:
  /// tolerance: of inverse depths.
  Hearing(float inverse_depth, float tolerance) : tolerance_(tolerance / inverse_depth) {}

  void add(const Look& look) {
    ++count_[int(look.sight)];
    const float off = (look.ratio - 1) / tolerance_, spread = look.spread / tolerance_;
    if (!(std::abs(off) < kReach)) return;
    const float closeness = 1 - off * off / (kReach * kReach);
    // Between pixels far apart, at rims and edges, depth is not what is interpolated.
    const float weight = closeness * closeness / (1 + spread * spread);
    weight_ += weight;
    sum_ += weight * off;
  }

  int count(Sight sight) const { return count_[int(sight)]; }
  /// Of the inverse depth that they and the view itself agree on, to the view's own.
  float ratio() const { return 1 + tolerance_ * sum_ / weight_; }

 private:
  static constexpr float kReach = 2;  ///< of the biweight, in tolerances
  float tolerance_;
  std::array<int, 4> count_{};
  float weight_ = 1, sum_ = 0;
};

/// Views that must see a point when so many should.
int usual_support(int should_see) {
  constexpr int kLeast = 2;
  return std::max(kLeast, int(std::ceil(kSupportShare * should_see - 1e-9)));
}

void check_maps(const DepthView& view) {
  const FloatMap& map = view.inverse_depth;
  require_argument(
      map.width() == view.camera.width && map.height() == view.camera.height && map.channels() == 1,
      "view.inverse_depth: must be as large as the camera's picture");
  require_argument(view.confidence.empty() || (view.confidence.width() == map.width() &&
                                               view.confidence.height() == map.height()),
                   "view.confidence: must be as large as inverse_depth");
  require_argument(view.picture.empty() ||
                       (view.picture.width() == map.width() &&
                        view.picture.height() == map.height() && view.picture.channels() >= 3),
                   "view.picture: must be as large as inverse_depth, with three channels");
}

}  // namespace

PointCounts& PointCounts::operator+=(const PointCounts& other) {
  pixels += other.pixels;
  without_estimate += other.without_estimate;
  ground += other.ground;
  unsure += other.unsure;
  too_far += other.too_far;
  contradicted += other.contradicted;
  unconfirmed += other.unconfirmed;
  points += other.points;
  return *this;
}

std::vector<int> witnesses_of(const std::vector<Camera>& cameras, int view, int most) {
  require_argument(view >= 0 && std::size_t(view) < cameras.size(),
                   "view: there is no such camera");
  require_argument(most >= 0, "most: must be 0 or more");
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
  check_maps(view);
  for (const DepthView& witness : witnesses) check_maps(witness);
  const int width = view.inverse_depth.width(), height = view.inverse_depth.height();
  KeptPixels kept{Mask(width, height), FloatMap(width, height), view.inverse_depth, {}};
  const float finest = finest_difference(view, witnesses);
  std::vector<PointCounts> counts(height);
  const auto keep = [&](int u, int v, PointCounts& row) {
    const float w = view.inverse_depth(u, v);
    ++row.pixels;
    if (w == 0) return ++row.ground, false;
    if (!(w > 0) || !std::isfinite(w)) return ++row.without_estimate, false;
    if (!view.confidence.empty() && !(view.confidence(u, v) >= options.least_confidence))
      return ++row.unsure, false;
    if (w < kTooFar * tolerance.between_views) return ++row.too_far, false;
    const Eigen::Vector3d point = point_of(view, u, v);
    const float between_views = tolerance.at(w, finest);
    Hearing hearing(w, between_views);
    for (const DepthView& witness : witnesses)
      hearing.add(look_at(witness.camera, witness.inverse_depth, point, between_views,
                          tolerance.between_pixels));
    const int sees = hearing.count(Sight::kSees), through = hearing.count(Sight::kSeesThrough);
    const int unclear = hearing.count(Sight::kUnclear);
    kept.support(u, v) = float(sees);
    if (through > sees) return ++row.contradicted, false;
    const int wanted = options.least_support.value_or(usual_support(sees + through + unclear));
    if (sees < std::min(wanted, int(witnesses.size()))) return ++row.unconfirmed, false;
    kept.inverse_depth(u, v) = w * hearing.ratio();
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
  check_maps(view);
  require_argument(kept.keep.width() == view.inverse_depth.width() &&
                       kept.keep.height() == view.inverse_depth.height() &&
                       kept.support.width() == kept.keep.width() &&
                       kept.support.height() == kept.keep.height(),
                   "kept: must be as large as the maps of the view");
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
      cloud.colours.push_back({view.byte(u, v, 0), view.byte(u, v, 1), view.byte(u, v, 2)});
      cloud.confidences.push_back(view.confidence.empty() ? 1 : view.confidence(u, v));
      cloud.supports.push_back(kept.support(u, v));
    }
  return cloud;
}

}  // namespace gigaray
