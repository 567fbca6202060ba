// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/samplers/unstructured_sampler.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

/// Nearer to the plane of the other camera than this share of the distance to the reference camera
/// a point counts as behind it.
constexpr double kBehind = 1e-4;

void check_view(int view, int num_views) {
  require_argument(view >= 0 && view < num_views, "view: the sampler has no such view");
}

Eigen::Matrix3d intrinsics(const Camera& camera) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k(0, 0) = camera.focal_u;
  k(1, 1) = camera.focal_v;
  k(0, 2) = camera.centre_u;
  k(1, 2) = camera.centre_v;
  return k;
}

/// px that things in the middle of the volume are seen from where they would be if they were
/// infinitely far; pictures from one place, as those of exposure brackets, have less.
constexpr double kLeastParallax = 0.1;

/// How well a camera goes with the reference.
struct Fit {
  double overlap = 0;  ///< share of the reference's volume that it sees
  double angle = 0;    ///< median angle between the rays, degrees
  double scale = 1;    ///< median ratio of the distances in px, ≥ 1
};

Fit fit_of(const Camera& ref, const Camera& other) {
  constexpr int kAcross = 5, kDeep = 3;
  std::vector<double> angles, scales;
  int seen = 0;
  for (int k = 0; k < kDeep; ++k) {
    const double w = ref.inverse_depth->min +
                     (k + 0.5) / kDeep * (ref.inverse_depth->max - ref.inverse_depth->min);
    for (int j = 0; j < kAcross; ++j)
      for (int i = 0; i < kAcross; ++i) {
        const double u = (i + 0.5) / kAcross * ref.width, v = (j + 0.5) / kAcross * ref.height;
        const Eigen::Vector3d point = ref.back_project(u, v, 1 / w);
        if (!other.sees(point)) continue;
        ++seen;
        const Eigen::Vector3d a = point - ref.position(), b = point - other.position();
        angles.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
        const double ratio = other.focal_u * w / (ref.focal_u / other.project(point).z());
        scales.push_back(std::max(ratio, 1 / ratio));
      }
  }
  Fit fit;
  fit.overlap = double(seen) / (kAcross * kAcross * kDeep);
  if (seen == 0) return fit;
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  fit.angle = median(angles) * 180 / std::numbers::pi;
  fit.scale = median(scales);
  return fit;
}

std::vector<int> choose_partners(const std::vector<Camera>& cameras, int ref, int most) {
  struct Candidate {
    int view;
    double quality;
  };
  std::vector<Candidate> candidates;
  for (int view = 0; view < int(cameras.size()); ++view) {
    if (view == ref) continue;
    const Fit fit = fit_of(cameras[ref], cameras[view]);
    if (fit.overlap < UnstructuredSampler::kLeastOverlap ||
        fit.angle > UnstructuredSampler::kWidestAngle ||
        fit.scale > UnstructuredSampler::kMostScale)
      continue;
    if (fit.angle * std::numbers::pi / 180 * cameras[ref].focal_u < kLeastParallax) continue;
    // Much in common under small angles, but not from the same place.
    constexpr double kBestAngle = 8;
    const double angle = std::min(fit.angle / kBestAngle, kBestAngle / std::max(fit.angle, 1e-9));
    candidates.push_back({view, fit.overlap * std::min(1.0, angle) / fit.scale});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.quality > b.quality; });
  if (most > 0 && int(candidates.size()) > most) candidates.resize(most);
  std::vector<int> partners{ref};
  for (const Candidate& candidate : candidates) partners.push_back(candidate.view);
  std::sort(partners.begin(), partners.end());
  return partners;
}

}  // namespace

UnstructuredSampler::UnstructuredSampler(const std::vector<Camera>& cameras, int most_partners)
    : cameras_(cameras) {
  for (const Camera& camera : cameras)
    require_argument(camera.inverse_depth.has_value(), "cameras: each needs its inverse_depth");
  for (int ref = 0; ref < num_views(); ++ref)
    partners_.push_back(choose_partners(cameras, ref, most_partners));
}

std::vector<int> UnstructuredSampler::nearest_partners(int ref, std::size_t most) const {
  check_view(ref, num_views());
  std::vector<int> nearest = partners_[ref];
  std::erase(nearest, ref);
  const Eigen::Vector3d here = cameras_[ref].position();
  std::ranges::stable_sort(nearest, {},
                           [&](int view) { return (cameras_[view].position() - here).norm(); });
  nearest.resize(std::min(nearest.size(), most));
  return nearest;
}

double UnstructuredSampler::inverse_depth(int view, double hypothesis) const {
  const InverseDepthRange& range = *cameras_[view].inverse_depth;
  return range.min + hypothesis * (range.max - range.min);
}

double UnstructuredSampler::hypothesis(int view, double inverse_depth) const {
  const InverseDepthRange& range = *cameras_[view].inverse_depth;
  return (inverse_depth - range.min) / (range.max - range.min);
}

UnstructuredSampler::Pair UnstructuredSampler::pair(int ref, int other) const {
  if (ref == other) return {Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  const Camera &from = cameras_[ref], &to = cameras_[other];
  const Eigen::Matrix3d turn = to.rotation * from.rotation.transpose();
  const Eigen::Matrix3d k = intrinsics(to);
  return {k * turn * intrinsics(from).inverse(), k * (to.translation - turn * from.translation)};
}

UnstructuredSampler::Way UnstructuredSampler::way(int ref, int other) const {
  check_view(ref, num_views());
  check_view(other, num_views());
  const Pair go = pair(ref, other);
  Way way;
  way.from_ = *cameras_[ref].inverse_depth;
  way.to_ = *cameras_[other].inverse_depth;
  // M (u, v, 1) + (min + h (max − min)) m
  way.turn_ = go.turn;
  way.turn_.col(2) += way.from_.min * go.shift;
  way.shift_ = (way.from_.max - way.from_.min) * go.shift;
  return way;
}

std::optional<Ray> UnstructuredSampler::Way::operator()(Ray ray) const {
  const Eigen::Vector3d at =
      turn_.col(0) * ray.u + turn_.col(1) * ray.v + turn_.col(2) + shift_ * ray.hypothesis;
  if (!(at.z() > kBehind)) return std::nullopt;
  const double w = from_.min + ray.hypothesis * (from_.max - from_.min);
  return Ray{at.x() / at.z(), at.y() / at.z(), (w / at.z() - to_.min) / (to_.max - to_.min)};
}

std::optional<Ray> UnstructuredSampler::locate(int ref, int other, Ray ray) const {
  if (ref == other) return ray;
  const Camera &from = cameras_[ref], &to = cameras_[other];
  const double w = inverse_depth(ref, ray.hypothesis);
  // Everything divided by the depth, which may be infinite.
  const Eigen::Vector3d direction((ray.u - from.centre_u) / from.focal_u,
                                  (ray.v - from.centre_v) / from.focal_v, 1);
  const Eigen::Vector3d at =
      to.rotation * (from.rotation.transpose() * (direction - w * from.translation)) +
      w * to.translation;
  if (!(at.z() > kBehind)) return std::nullopt;
  return Ray{to.focal_u * at.x() / at.z() + to.centre_u, to.focal_v * at.y() / at.z() + to.centre_v,
             hypothesis(other, w / at.z())};
}

RowRange UnstructuredSampler::rows_needed(int ref, RowRange rows, HypothesisRange range,
                                          int height) const {
  check_view(ref, num_views());
  // A quotient of linear functions takes its extremes at the corners of (u, v, w), as long as all
  // are before the camera.
  const RowRange own = grown(rows, 0, height);
  RowRange needed = own;
  const double right = cameras_[ref].width - 1;
  for (const int other : partners_[ref]) {
    if (other == ref) continue;
    double top = own.begin, bottom = own.end - 1;
    for (const double u : {0.0, right})
      for (const int v : {rows.begin, rows.end - 1})
        for (const double h : {range.min, range.max}) {
          const auto there = locate(ref, other, Ray{u, double(v), h});
          if (!there) return {0, height};
          top = std::min(top, there->v);
          bottom = std::max(bottom, there->v);
        }
    // One more for rounding.
    const double begin = std::floor(std::max(top, 0.0)) - 1,
                 end = std::ceil(std::min(bottom, height - 1.0)) + 2;
    needed.begin = std::clamp(int(begin), 0, needed.begin);
    needed.end = std::clamp(int(end), needed.end, height);
  }
  return needed;
}

UnstructuredSampler UnstructuredSampler::at_level(int level) const {
  UnstructuredSampler scaled = *this;
  for (Camera& camera : scaled.cameras_) {
    for (double* length : {&camera.focal_u, &camera.focal_v, &camera.centre_u, &camera.centre_v})
      *length = std::ldexp(*length, -level);
    for (int i = 0; i < level; ++i) {
      camera.width = (camera.width + 1) / 2;
      camera.height = (camera.height + 1) / 2;
    }
  }
  return scaled;
}

UnstructuredSampler UnstructuredSampler::subset(const std::vector<int>& views) const {
  UnstructuredSampler some;
  for (const int view : views) {
    check_view(view, num_views());
    some.cameras_.push_back(cameras_[view]);
    std::vector<int> partners;
    for (std::size_t i = 0; i < views.size(); ++i)
      if (std::binary_search(partners_[view].begin(), partners_[view].end(), views[i]))
        partners.push_back(int(i));
    some.partners_.push_back(std::move(partners));
  }
  return some;
}

std::vector<float> UnstructuredSampler::ray_table(int ref) const {
  check_view(ref, num_views());
  std::vector<float> table;
  for (int other = 0; other < num_views(); ++other) {
    const Way go = way(ref, other);
    const double per_depth = 1 / (go.to_.max - go.to_.min);
    for (int row = 0; row < 3; ++row)
      table.insert(table.end(), {float(go.turn_(row, 0)), float(go.turn_(row, 1)),
                                 float(go.turn_(row, 2)), float(go.shift_[row])});
    table.insert(table.end(),
                 {float(go.from_.min * per_depth), float((go.from_.max - go.from_.min) * per_depth),
                  float(go.to_.min * per_depth), 0.0f});
  }
  return table;
}

double UnstructuredSampler::travel(int ref, int other) const {
  check_view(ref, num_views());
  check_view(other, num_views());
  const Ray centre{cameras_[ref].width / 2.0, cameras_[ref].height / 2.0, 0};
  const auto far = locate(ref, other, centre), near = locate(ref, other, {centre.u, centre.v, 1});
  return far && near ? std::hypot(near->u - far->u, near->v - far->v) : 0;
}

}  // namespace gigaray
