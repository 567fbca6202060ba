// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "synthetic_builder.h"

#include <algorithm>
#include <cmath>

#include "synthetic_noise.h"

namespace gigaray::synthetic {
namespace {

/// A rod is never thinner than this, or pixels between two pixel centres would miss it.
constexpr double kMinRadiusPx = 0.8;

}  // namespace

SceneBuilder::SceneBuilder(const SyntheticOptions& options)
    : scene_(Rig(options)), seed_(options.seed) {}

double SceneBuilder::uniform_at(std::uint64_t draw, double low, double high) const {
  constexpr std::uint64_t kSceneKey = 0x5ce4e;
  return uniform(hash(seed_, kSceneKey, draw), low, high);
}

int SceneBuilder::material(Pattern pattern, Colour dark, Colour mid, Colour light, float scale,
                           float persistence) {
  constexpr std::uint64_t kMaterialKey = 0x3a7e;
  Material material;
  material.pattern = pattern;
  material.dark = dark;
  material.mid = mid;
  material.light = light;
  material.scale = scale;
  material.persistence = persistence;
  material.seed = std::uint32_t(hash(seed_, kMaterialKey, scene_.materials.size()));
  scene_.materials.push_back(material);
  return int(scene_.materials.size()) - 1;
}

/// With nearness n(x, y) = nearness + per_x (x - at.x) + per_y (y - at.y) in the centre view, 1 / Z
/// is affine in (X / Z, Y / Z), so the surface is a plane.
Primitive SceneBuilder::plane_through(double nearness, double per_x, double per_y, Place at) const {
  const Rig& rig = scene_.rig;
  const double k = 1 - 1 / rig.far_z;
  Primitive plane;
  plane.normal = {k * per_x * rig.focal / rig.width, k * per_y * rig.focal / rig.height,
                  1 / rig.far_z + k * (nearness - per_x * at.x - per_y * at.y)};
  plane.plane_k = 1;
  // Along: horizontal. Across: downwards or towards the viewer.
  plane.along = normalised(Vec3d{plane.normal.z, 0, -plane.normal.x});
  const Vec3d n = normalised(plane.normal), a = plane.along;
  plane.across = cross(n, a);
  plane.x0 = plane.y0 = -kNoHit;
  plane.x1 = plane.y1 = kNoHit;
  return plane;
}

void SceneBuilder::backdrop(int material) {
  Primitive plane = plane_through(0, 0, 0, {});
  plane.material = material;
  scene_.primitives.push_back(plane);
}

void SceneBuilder::slope(Place a, Place b, int material) {
  const Rig& rig = scene_.rig;
  const double dx = b.x - a.x, dy = b.y - a.y, rise = b.nearness - a.nearness;
  GIGARAY_CHECK((dx == 0) != (dy == 0) && rise != 0);
  const double per_x = dx == 0 ? 0 : rise / dx, per_y = dy == 0 ? 0 : rise / dy;
  Primitive plane = plane_through(a.nearness, per_x, per_y, a);
  plane.material = material;
  Primitive wall = plane_through(1, 0, 0, {});
  wall.material = material;
  const auto limit = [&](double from, double per, double side, double& low, double& high,
                         double& wall_low, double& wall_high) {
    const double far_end = (from - a.nearness / per) * side;
    const double near_end = (from + (1 - a.nearness) / per) * side;
    low = std::min(far_end, near_end);
    high = std::max(far_end, near_end);
    (per > 0 ? wall_low : wall_high) = near_end;
  };
  if (dx != 0) limit(a.x, per_x, rig.width, plane.x0, plane.x1, wall.x0, wall.x1);
  if (dy != 0) limit(a.y, per_y, rig.height, plane.y0, plane.y1, wall.y0, wall.y1);
  scene_.primitives.push_back(wall);
  scene_.primitives.push_back(plane);
}

void SceneBuilder::card(Place place, double half_x, double half_y, int material, double slope_x,
                        double slope_y) {
  const Rig& rig = scene_.rig;
  const double side = std::min(rig.width, rig.height);
  GIGARAY_CHECK(place.nearness + std::abs(slope_x) + std::abs(slope_y) <= 1 + 1e-12 &&
                place.nearness - std::abs(slope_x) - std::abs(slope_y) >= -1e-12);
  Primitive card = plane_through(place.nearness, slope_x / (half_x * side / rig.width),
                                 slope_y / (half_y * side / rig.height), place);
  card.material = material;
  card.x0 = place.x * rig.width - half_x * side;
  card.x1 = place.x * rig.width + half_x * side;
  card.y0 = place.y * rig.height - half_y * side;
  card.y1 = place.y * rig.height + half_y * side;
  scene_.primitives.push_back(card);
}

void SceneBuilder::disc(Place place, double half_x, double half_y, int material, double slope_x,
                        double slope_y) {
  card(place, half_x, half_y, material, slope_x, slope_y);
  scene_.primitives.back().kind = Primitive::Kind::kDisc;
}

void SceneBuilder::wedge(Place tip, double base_y, double half_x, int material) {
  const Rig& rig = scene_.rig;
  card(tip, half_x, 1, material);
  Primitive& wedge = scene_.primitives.back();
  wedge.kind = Primitive::Kind::kWedge;
  wedge.y0 = tip.y * rig.height;
  wedge.y1 = base_y * rig.height;
}

double SceneBuilder::radius_at(double radius, double nearness) const {
  const Rig& rig = scene_.rig;
  const double px = std::max(kMinRadiusPx, radius * std::min(rig.width, rig.height));
  return px * rig.z(nearness) / rig.focal;
}

void SceneBuilder::ball(Place place, double radius, int material) {
  Primitive ball;
  ball.kind = Primitive::Kind::kBall;
  ball.material = material;
  ball.radius = radius_at(radius, place.nearness);
  ball.centre = scene_.rig.point(place.x, place.y, place.nearness);
  // Pushed back along the line of sight of its middle, then to where the front is at the nearness.
  const double depth = ball.centre.z + ball.radius;
  ball.centre = (depth / ball.centre.z) * ball.centre;
  scene_.primitives.push_back(ball);
}

void SceneBuilder::rod(Place from, Place to, double radius, int material) {
  Primitive rod;
  rod.kind = Primitive::Kind::kRod;
  rod.material = material;
  rod.radius = radius_at(radius, std::max(from.nearness, to.nearness));
  const auto behind = [&](Place place) {
    const Vec3d p = scene_.rig.point(place.x, place.y, place.nearness);
    return ((p.z + rod.radius) / p.z) * p;
  };
  rod.centre = behind(from);
  const Vec3d span = behind(to) - rod.centre;
  rod.length = std::sqrt(dot(span, span));
  rod.axis = normalised(span);
  scene_.primitives.push_back(rod);
}

void SceneBuilder::railing(Place left, Place right, double height, int num_bars, double radius,
                           int material) {
  const auto between = [&](double k, double rise) {
    return Place{left.x + k * (right.x - left.x), left.y + k * (right.y - left.y) - rise,
                 left.nearness + k * (right.nearness - left.nearness)};
  };
  rod(between(0, height), between(1, height), 1.3 * radius, material);
  rod(between(0, 0.2 * height), between(1, 0.2 * height), radius, material);
  for (int i = 0; i < num_bars; ++i) {
    const double k = (i + 0.5) / num_bars;
    rod(between(k, 0), between(k, height), radius, material);
  }
}

void SceneBuilder::panel(Vec3d centre, Vec3d half_along, Vec3d half_across, int material) {
  Primitive panel;
  panel.kind = Primitive::Kind::kPanel;
  panel.material = material;
  panel.centre = centre;
  panel.along = normalised(half_along);
  panel.across = normalised(half_across);
  panel.x1 = dot(half_along, panel.along);
  panel.y1 = dot(half_across, panel.across);
  panel.normal = cross(panel.along, panel.across);
  scene_.primitives.push_back(panel);
}

void SceneBuilder::box(Vec3d centre, Vec3d half_x, Vec3d half_y, Vec3d half_z, int material) {
  for (const double side : {-1.0, 1.0}) {
    panel(centre + side * half_z, half_x, half_y, material);
    panel(centre + side * half_x, half_z, half_y, material);
    panel(centre + side * half_y, half_x, half_z, material);
  }
}

void SceneBuilder::pole(Vec3d from, Vec3d to, double radius, int material) {
  Primitive pole;
  pole.kind = Primitive::Kind::kRod;
  pole.material = material;
  pole.radius = std::max(radius, kMinRadiusPx * std::min(from.z, to.z) * scene_.rig.pixel());
  pole.centre = from;
  const Vec3d span = to - from;
  pole.length = std::sqrt(dot(span, span));
  pole.axis = normalised(span);
  scene_.primitives.push_back(pole);
}

void SceneBuilder::globe(Vec3d centre, double radius, int material) {
  Primitive globe;
  globe.kind = Primitive::Kind::kBall;
  globe.material = material;
  globe.centre = centre;
  globe.radius = radius;
  scene_.primitives.push_back(globe);
}

void SceneBuilder::shell(Vec3d centre, double radius, int material) {
  globe(centre, radius, material);
  scene_.primitives.back().kind = Primitive::Kind::kShell;
}

void SceneBuilder::add_gloss(int material, Place place, Vec3d normal, float strength, int power) {
  const Vec3d p = scene_.rig.point(place.x, place.y, place.nearness);
  const Vec3d to_viewer = normalised(-1.0 * p);
  normal = normalised(normal);
  if (dot(normal, to_viewer) < 0) normal = -1.0 * normal;
  Material& glossy = scene_.materials[material];
  glossy.gloss = strength;
  glossy.gloss_power = power;
  glossy.gloss_direction = to_float(2 * dot(normal, to_viewer) * normal - to_viewer);
}

}  // namespace gigaray::synthetic
