// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "synthetic_scene.h"

namespace gigaray::synthetic {

/// A place in the centre view: x, y in fractions of width and height from the middle of the
/// picture, nearness 0 … 1 over the disparity range.
struct Place {
  double x = 0, y = 0, nearness = 0;
};

/// Puts surfaces into a scene, placed by what the centre view sees, so that a scene fits any size
/// and any disparity range. Sizes are fractions of the shorter side of the picture as seen at that
/// place.
class SceneBuilder {
 public:
  explicit SceneBuilder(const SyntheticOptions& options);

  /// Seeded, uniform in [low, high); each call gives the next value.
  double random(double low, double high) { return uniform_at(++draws_, low, high); }
  double height_over_width() const { return scene_.rig.height / scene_.rig.width; }
  Scene finish() { return std::move(scene_); }

  /// Each returns the index of a new material with its own texture.
  int material(Pattern pattern, Colour dark, Colour mid, Colour light, float scale,
               float persistence = 0.7f);
  Material& edit(int material) { return scene_.materials[material]; }

  /// The wall at the far end of the range; every scene needs it, nothing can be seen behind it.
  void backdrop(int material);
  /// An infinite slanted plane: nearness changes linearly from place a to place b and is constant
  /// across that direction. It ends where it meets the far and the near end of the range; beyond
  /// the near end a wall stands in its place.
  void slope(Place a, Place b, int material);
  /// What the centre view sees inside the rectangle of half size (half_x, half_y) around the place:
  /// a plane whose nearness changes by slope_x and slope_y from the middle to the rim.
  void card(Place place, double half_x, double half_y, int material, double slope_x = 0,
            double slope_y = 0);
  /// The same with an elliptic outline.
  void disc(Place place, double half_x, double half_y, int material, double slope_x = 0,
            double slope_y = 0);
  /// What the centre view sees in a triangle of constant nearness: from its tip at `tip` to a base
  /// of half width half_x in the height base_y (a fraction of the picture's height, above or
  /// below).
  void wedge(Place tip, double base_y, double half_x, int material);
  /// A ball or a rod with round ends; the foremost point has the nearness stated.
  void ball(Place place, double radius, int material);
  void rod(Place from, Place to, double radius, int material);
  /// Two rails and their upright bars between two places of the same height.
  void railing(Place left, Place right, double height, int num_bars, double radius, int material);
  // The same in scene units, for scenes that cameras look at from all sides.
  /// A rectangle around a point: two vectors from there to the middles of two sides.
  void panel(Vec3d centre, Vec3d half_along, Vec3d half_across, int material);
  /// Six panels: three vectors from the middle to those of three faces.
  void box(Vec3d centre, Vec3d half_x, Vec3d half_y, Vec3d half_z, int material);
  /// A rod between two points, a ball, and a ball that everything stands in. Rods are never thinner
  /// than a pixel and a half where they are nearer.
  void pole(Vec3d from, Vec3d to, double radius, int material);
  void globe(Vec3d centre, double radius, int material);
  void shell(Vec3d centre, double radius, int material);
  /// Half of the picture's width and height at Z = 1.
  double half_width() const { return 0.5 * scene_.rig.width / scene_.rig.focal; }
  double half_height() const { return 0.5 * scene_.rig.height / scene_.rig.focal; }
  /// Depth of the point that paths go around.
  double middle_z() const { return scene_.rig.z(0.5); }

  /// Makes the surface under a place of a card mirror a lamp there in the centre view.
  void add_gloss(int material, Place place, Vec3d normal, float strength, int power);
  /// Normal of the card that was added last.
  Vec3d last_normal() const { return scene_.primitives.back().normal; }

 private:
  double uniform_at(std::uint64_t draw, double low, double high) const;
  Primitive plane_through(double nearness, double per_x, double per_y, Place at) const;
  double radius_at(double radius, double nearness) const;

  Scene scene_;
  std::uint64_t seed_;
  std::uint64_t draws_ = 0;
};

}  // namespace gigaray::synthetic
