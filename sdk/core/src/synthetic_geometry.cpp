// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "synthetic_options.h"
#include "synthetic_scene.h"

namespace gigaray::synthetic {
namespace {

/// Z of the farthest surface over that of the nearest: enough for a lively perspective.
constexpr double kDepthRatio = 2.5;
constexpr double kDepthRatioOfRooms = 4;
/// Focal length over the longer side of the picture.
constexpr double kFocalOverSize = 1.2;

/// Smallest root above zero of a z² + 2 b z + c, given that the ray starts outside; else kNoHit.
double first_root(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kNoHit;
  const double z = (-b - std::sqrt(discriminant)) / a;
  return z > 0 ? z : kNoHit;
}

double intersect_ball(Vec3d centre, double radius, Vec3d origin, Vec3d direction) {
  const Vec3d from_centre = origin - centre;
  return first_root(dot(direction, direction), dot(direction, from_centre),
                    dot(from_centre, from_centre) - radius * radius);
}

double intersect_shell(Vec3d centre, double radius, Vec3d origin, Vec3d direction) {
  const Vec3d from_centre = origin - centre;
  const double a = dot(direction, direction), b = dot(direction, from_centre);
  const double c = dot(from_centre, from_centre) - radius * radius;
  const double discriminant = b * b - a * c;
  return c < 0 && discriminant > 0 ? (-b + std::sqrt(discriminant)) / a : kNoHit;
}

double intersect_panel(const Primitive& panel, Vec3d origin, Vec3d direction) {
  const double k = dot(panel.normal, panel.centre - origin) / dot(panel.normal, direction);
  if (!(k > 0) || k == kNoHit) return kNoHit;
  const Vec3d p = origin + k * direction - panel.centre;
  const bool is_inside =
      std::abs(dot(p, panel.along)) <= panel.x1 && std::abs(dot(p, panel.across)) <= panel.y1;
  return is_inside ? k : kNoHit;
}

double intersect_rod(const Primitive& rod, Vec3d origin, Vec3d direction) {
  const Vec3d from_end = origin - rod.centre;
  const double along = dot(rod.axis, from_end), climb = dot(rod.axis, direction);
  const Vec3d m = from_end - along * rod.axis, n = direction - climb * rod.axis;
  const double a = dot(n, n);
  if (a > 0) {
    const double z = first_root(a, dot(m, n), dot(m, m) - rod.radius * rod.radius);
    if (z == kNoHit) return kNoHit;
    const double place = along + z * climb;
    if (place >= 0 && place <= rod.length) return z;
  }
  return std::min(
      intersect_ball(rod.centre, rod.radius, origin, direction),
      intersect_ball(rod.centre + rod.length * rod.axis, rod.radius, origin, direction));
}

bool is_round(const Primitive& primitive) {
  return primitive.kind == Primitive::Kind::kBall || primitive.kind == Primitive::Kind::kShell ||
         primitive.kind == Primitive::Kind::kRod;
}

bool card_covers(const Primitive& card, double x, double y) {
  if (card.kind == Primitive::Kind::kCard)
    return x >= card.x0 && x <= card.x1 && y >= card.y0 && y <= card.y1;
  if (card.kind == Primitive::Kind::kWedge) {
    const double from_tip = (y - card.y0) / (card.y1 - card.y0);
    return from_tip >= 0 && from_tip <= 1 &&
           std::abs(2 * x - card.x0 - card.x1) <= from_tip * (card.x1 - card.x0);
  }
  const double ex = (2 * x - card.x0 - card.x1) / (card.x1 - card.x0);
  const double ey = (2 * y - card.y0 - card.y1) / (card.y1 - card.y0);
  return ex * ex + ey * ey <= 1;
}

}  // namespace

Rig::Rig(const SyntheticOptions& options)
    : width(options.width),
      height(options.height),
      cx((options.width - 1) / 2.0),
      cy((options.height - 1) / 2.0),
      focal(kFocalOverSize * std::max(options.width, options.height)),
      far_z(has_room_around(options.scene) ? kDepthRatioOfRooms : kDepthRatio),
      near_disparity((options.disparity.max - options.disparity.min) * far_z / (far_z - 1)),
      offset(options.disparity.max - near_disparity) {}

Vec3d Rig::point(double x, double y, double nearness) const {
  const double depth = z(nearness);
  return {x * width * depth / focal, y * height * depth / focal, depth};
}

RigGeometry Rig::geometry() const {
  // A positive offset means cameras that diverge; there is no focus distance to state.
  if (offset > 0) return {};
  std::optional<double> focus_distance;
  if (offset < 0) focus_distance = -near_disparity / offset;
  return {focal, near_disparity / focal, focus_distance, "m"};
}

ViewRays::ViewRays(const Rig& rig, const View& view)
    : origin_{view.s * rig.near_disparity / rig.focal, view.t * rig.near_disparity / rig.focal, 0},
      u0_(rig.cx - view.s * rig.offset),
      v0_(rig.cy - view.t * rig.offset),
      focal_(rig.focal),
      inverse_focal_(1 / rig.focal) {}

ViewRays::ViewRays(const gigaray::Camera& camera, double distortion)
    : u0_(camera.centre_u),
      v0_(camera.centre_v),
      focal_(camera.focal_u),
      inverse_focal_(1 / camera.focal_u),
      is_posed_(true),
      distortion_(distortion) {
  const auto axis = [&](int row) {
    return Vec3d{camera.rotation(row, 0), camera.rotation(row, 1), camera.rotation(row, 2)};
  };
  right_ = axis(0);
  down_ = axis(1);
  ahead_ = axis(2);
  const Eigen::Vector3d position = camera.position();
  origin_ = {position.x(), position.y(), position.z()};
}

Vec3d ViewRays::undistorted(double u, double v) const {
  if (distortion_ == 0) return {u, v, 0};
  const double x = (u - u0_) * inverse_focal_, y = (v - v0_) * inverse_focal_;
  // Newton's method for r (1 + k1 r²) = the distorted radius.
  const double distorted = std::sqrt(x * x + y * y);
  double r = distorted;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i)
    r -= (r * (1 + distortion_ * r * r) - distorted) / (1 + 3 * distortion_ * r * r);
  const double k = distorted > 0 ? r / distorted : 1;
  return {u0_ + k * (u - u0_), v0_ + k * (v - v0_), 0};
}

Vec3d ViewRays::direction(double u, double v) const {
  const Vec3d pixel = undistorted(u, v);
  const double x = (pixel.x - u0_) * inverse_focal_, y = (pixel.y - v0_) * inverse_focal_;
  return is_posed_ ? x * right_ + y * down_ + ahead_ : Vec3d{x, y, 1};
}

Vec3d ViewRays::project(Vec3d p) const {
  const Vec3d from = p - origin_;
  const double z = dot(ahead_, from);
  return {u0_ + focal_ * dot(right_, from) / z, v0_ + focal_ * dot(down_, from) / z, z};
}

double intersect(const Primitive& primitive, const Rig& rig, Vec3d origin, Vec3d direction) {
  switch (primitive.kind) {
    case Primitive::Kind::kCard:
    case Primitive::Kind::kDisc:
    case Primitive::Kind::kWedge: {
      const double k =
          (primitive.plane_k - dot(primitive.normal, origin)) / dot(primitive.normal, direction);
      if (!(k > 0) || k == kNoHit) return kNoHit;
      const Vec3d p = origin + k * direction;
      if (!(p.z > 0)) return kNoHit;
      return card_covers(primitive, rig.focal * p.x / p.z, rig.focal * p.y / p.z) ? k : kNoHit;
    }
    case Primitive::Kind::kBall:
      return intersect_ball(primitive.centre, primitive.radius, origin, direction);
    case Primitive::Kind::kRod:
      return intersect_rod(primitive, origin, direction);
    case Primitive::Kind::kPanel:
      return intersect_panel(primitive, origin, direction);
    case Primitive::Kind::kShell:
      return intersect_shell(primitive.centre, primitive.radius, origin, direction);
  }
  return kNoHit;
}

Vec3d surface_normal(const Primitive& primitive, Vec3d p, Vec3d direction) {
  Vec3d normal = primitive.normal;
  if (is_round(primitive) && primitive.kind != Primitive::Kind::kRod) {
    normal = p - primitive.centre;
  } else if (primitive.kind == Primitive::Kind::kRod) {
    const Vec3d from_end = p - primitive.centre;
    const double place = std::clamp(dot(from_end, primitive.axis), 0.0, primitive.length);
    normal = from_end - place * primitive.axis;
  }
  normal = normalised(normal);
  return dot(normal, direction) > 0 ? -1.0 * normal : normal;
}

Vec3f texture_point(const Primitive& primitive, Vec3d p) {
  if (is_round(primitive)) return to_float(p);
  return {float(dot(p, primitive.along)), float(dot(p, primitive.across)), 0};
}

PixelBox bounds(const Primitive& primitive, const Rig& rig, const ViewRays& rays) {
  PixelBox box{kNoHit, -kNoHit, kNoHit, -kNoHit};
  const PixelBox everywhere{-kNoHit, kNoHit, -kNoHit, kNoHit};
  bool is_before = true;
  const auto grow = [&](Vec3d p) {
    const auto [u, v, z] = rays.project(p);
    is_before &= z > 0;
    box = {std::min(box.u0, u), std::max(box.u1, u), std::min(box.v0, v), std::max(box.v1, v)};
  };
  if (primitive.kind == Primitive::Kind::kShell) return everywhere;
  if (primitive.kind == Primitive::Kind::kPanel) {
    for (const double x : {-primitive.x1, primitive.x1})
      for (const double y : {-primitive.y1, primitive.y1})
        grow(primitive.centre + x * primitive.along + y * primitive.across);
    return is_before ? box : everywhere;
  }
  if (!is_round(primitive)) {
    for (const double x : {primitive.x0, primitive.x1}) {
      for (const double y : {primitive.y0, primitive.y1}) {
        if (!std::isfinite(x) || !std::isfinite(y)) return everywhere;
        const Vec3d direction{x / rig.focal, y / rig.focal, 1};
        const double z = primitive.plane_k / dot(primitive.normal, direction);
        if (!(z > 0)) return everywhere;
        grow(z * direction);
      }
    }
    return is_before ? box : everywhere;
  }
  const double r = primitive.radius;
  for (const double place : {0.0, primitive.length}) {
    const Vec3d c = primitive.centre + place * primitive.axis;
    if (c.z - r <= 0) return everywhere;
    for (const double dx : {-r, r})
      for (const double dy : {-r, r})
        for (const double dz : {-r, r}) grow(c + Vec3d{dx, dy, dz});
  }
  return is_before ? box : everywhere;
}

}  // namespace gigaray::synthetic
