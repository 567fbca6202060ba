// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "synthetic_room_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gigaray::synthetic {
namespace {

/// Beyond everything, so that a camera outside of a room sees something too.
constexpr double kOutside = 100;

int plain(SceneBuilder& b, Colour colour) { return b.material(Pattern::kPlain, {}, colour, {}, 1); }

/// Noise around a colour, `contrast` to either side.
int cloudy(SceneBuilder& b, Colour mid, float contrast, float scale) {
  const Colour step{contrast, contrast, contrast};
  return b.material(Pattern::kNoise, mid - step, mid, mid + step, scale, 0.9f);
}

int parquet(SceneBuilder& b) {
  return b.material(Pattern::kBricks, {0.24f, 0.15f, 0.09f}, {0.55f, 0.38f, 0.24f},
                    {0.82f, 0.66f, 0.46f}, 0.08f, 1.0f);
}

int wood(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.20f, 0.12f, 0.07f}, {0.48f, 0.31f, 0.18f},
                    {0.76f, 0.57f, 0.38f}, 0.05f, 0.95f);
}

int painting(SceneBuilder& b, Colour mid) {
  return b.material(Pattern::kMarble, 0.35f * mid, mid, 0.4f * mid + Colour{0.55f, 0.55f, 0.52f},
                    0.12f, 0.9f);
}

/// Walls, floor and ceiling of a room that a camera may stand in.
struct Room {
  double floor = 0, ceiling = -1.1;  ///< y
  double left = -2.2, right = 1.7;   ///< x
  double front = -1.2, back = 4;     ///< z
  double middle_x() const { return (left + right) / 2; }
  double middle_y() const { return (ceiling + floor) / 2; }
  double middle_z() const { return (front + back) / 2; }
  double half_width() const { return (right - left) / 2; }
  double half_height() const { return (floor - ceiling) / 2; }
  double half_depth() const { return (back - front) / 2; }
};

void add_walls(SceneBuilder& b, const Room& room) {
  const Vec3d x{room.half_width(), 0, 0}, y{0, room.half_height(), 0}, z{0, 0, room.half_depth()};
  const Vec3d middle{room.middle_x(), room.middle_y(), room.middle_z()};
  const int wallpaper = cloudy(b, {0.62f, 0.60f, 0.50f}, 0.05f, 0.2f);
  b.panel(middle + y, x, z, parquet(b));
  b.panel(middle - y, x, z, plain(b, {0.93f, 0.92f, 0.90f}));
  b.panel(middle + z, x, y, cloudy(b, {0.80f, 0.78f, 0.72f}, 0.015f, 0.9f));
  b.panel(middle - z, x, y, wallpaper);
  b.panel(middle - x, z, y, wallpaper);
  b.panel(middle + x, z, y, wallpaper);
}

/// A wall from beside the viewer to the back, at a slant, with a picture on it and a bare dark
/// strip along the floor, as the back wall has.
void add_partition(SceneBuilder& b, const Room& room) {
  const Vec3d near{-1.15, 0, 1.8}, far{-0.75, 0, room.back};
  const Vec3d half = 0.5 * (far - near), up{0, -1, 0};
  const Vec3d middle = 0.5 * (near + far);
  const Vec3d inwards = normalised(Vec3d{half.z, 0, -half.x});
  const auto on_wall = [&](double place, double y, double thickness) {
    return middle + place * half + Vec3d{0, y, 0} + thickness * inwards;
  };
  b.box(on_wall(0, room.middle_y(), -0.05), half, room.half_height() * up, 0.05 * inwards,
        cloudy(b, {0.70f, 0.74f, 0.76f}, 0.035f, 0.25f));
  b.panel(on_wall(0.1, -0.32, 0.012), 0.34 * half, 0.2 * up, plain(b, {0.16f, 0.12f, 0.10f}));
  b.panel(on_wall(0.1, -0.32, 0.015), 0.3 * half, 0.16 * up, painting(b, {0.34f, 0.50f, 0.40f}));
  constexpr double kStrip = 0.06;
  const int dark = plain(b, {0.11f, 0.09f, 0.08f});
  b.panel(on_wall(0, room.floor - kStrip, 0.015), half, kStrip * up, dark);
  b.panel({0.5, room.floor - kStrip, room.back - 0.015}, {1.25, 0, 0}, kStrip * up, dark);
}

void add_table(SceneBuilder& b, const Room& room) {
  const double x0 = b.random(0.06, 0.1), x1 = x0 + 0.58, z0 = 2.05, z1 = 2.6, top = 0.1;
  constexpr double kHalfThickness = 0.012, kLegRadius = 0.0075, kInset = 0.03;
  const int look = wood(b);
  b.box({(x0 + x1) / 2, top, (z0 + z1) / 2}, {(x1 - x0) / 2, 0, 0}, {0, kHalfThickness, 0},
        {0, 0, (z1 - z0) / 2}, look);
  for (const double x : {x0 + kInset, x1 - kInset})
    for (const double z : {z0 + kInset, z1 - kInset})
      b.pole({x, top, z}, {x, room.floor, z}, kLegRadius, look);
  const double radius = 0.085;
  b.globe({x0 + 0.38, top - kHalfThickness - radius, 2.3}, radius,
          b.material(Pattern::kChecks, {0.62f, 0.14f, 0.12f}, {0.86f, 0.55f, 0.40f},
                     {0.98f, 0.93f, 0.80f}, 0.06f, 0.9f));
}

void add_sofa(SceneBuilder& b, const Room& room) {
  const int cloth = cloudy(b, {0.36f, 0.42f, 0.52f}, 0.06f, 0.12f);
  const double x = b.random(-0.5, -0.46), half = 0.3;
  const auto block = [&](double middle_x, double half_x, double height, double z0, double z1) {
    b.box({middle_x, room.floor - height / 2, (z0 + z1) / 2}, {half_x, 0, 0}, {0, height / 2, 0},
          {0, 0, (z1 - z0) / 2}, cloth);
  };
  block(x, half, 0.17, 2.7, 3.3);
  block(x, half, 0.42, 3.3, 3.45);
  for (const double side : {-1.0, 1.0}) block(x + side * half, 0.05, 0.27, 2.68, 3.45);
}

/// Folds of cloth before the back wall, shaded but hardly textured.
void add_curtain(SceneBuilder& b, const Room& room) {
  const int cloth = cloudy(b, {0.74f, 0.66f, 0.54f}, 0.02f, 0.1f);
  constexpr int kFolds = 9;
  constexpr double kRadius = 0.05, kApart = 0.085;
  for (int i = 0; i < kFolds; ++i) {
    const double x = 0.92 + kApart * i, z = room.back - 0.12 + b.random(-0.02, 0.02);
    b.pole({x, room.ceiling + kRadius, z}, {x, room.floor - 0.1, z}, kRadius, cloth);
  }
}

/// The nearest thing: a stool whose front is one away, at the lower right of any picture.
void add_stool(SceneBuilder& b, const Room& room) {
  const double x = 0.82 * b.half_width(), half_x = 0.11 * b.half_width();
  const double top = 0.4 * b.half_height(), depth = 0.08;
  b.box({x, (top + room.floor) / 2, 1 + depth}, {half_x, 0, 0}, {0, (room.floor - top) / 2, 0},
        {0, 0, depth}, wood(b));
}

}  // namespace

/// The floor comes to the lower border of the picture where it is hardly more than one away.
void build_room(SceneBuilder& b) {
  Room room;
  room.floor = std::max(0.28, 1.02 * b.half_height());
  add_walls(b, room);
  add_partition(b, room);
  const double z = room.back - 0.02;
  b.panel({0.2, -0.42, z}, {0.34, 0, 0}, {0, 0.24, 0}, plain(b, {0.16f, 0.12f, 0.10f}));
  b.panel({0.2, -0.42, z - 0.003}, {0.3, 0, 0}, {0, 0.2, 0}, painting(b, {0.62f, 0.42f, 0.32f}));
  add_table(b, room);
  add_sofa(b, room);
  add_curtain(b, room);
  add_stool(b, room);
  b.shell({0, 0, b.middle_z()}, kOutside, plain(b, {0.2f, 0.2f, 0.2f}));
}

/// A chair turned a little to the side and a ball, on nothing.
void build_figure(SceneBuilder& b) {
  const int white = plain(b, {1, 1, 1});
  b.edit(white).is_void = true;
  b.backdrop(white);
  b.shell({0, 0, b.middle_z()}, kOutside, white);

  constexpr double kUsualHalfHeight = 0.3125;
  const double size = std::min(b.half_width(), b.half_height()) / kUsualHalfHeight;
  const double turn = std::numbers::pi / 180 * b.random(22, 28);
  const Vec3d right{std::cos(turn), 0, std::sin(turn)}, ahead{-std::sin(turn), 0, std::cos(turn)};
  const auto at = [&](double x, double y, double z) {
    return Vec3d{0, size * y, b.middle_z()} + (size * x) * right + (size * z) * ahead;
  };
  const int frame = wood(b);
  constexpr double kHalf = 0.17, kSeat = 0.08, kFeet = 0.4, kTop = -0.36;
  constexpr double kLeg = 0.012, kBar = 0.006;
  const auto pole = [&](Vec3d from, Vec3d to, double radius) {
    b.pole(from, to, size * radius, frame);
  };
  b.box(at(0, kSeat, 0), (size * (kHalf + 0.015)) * right, {0, size * 0.015, 0},
        (size * (kHalf + 0.015)) * ahead, frame);
  b.box(at(0, kSeat - 0.035, 0), (size * 0.14) * right, {0, size * 0.02, 0}, (size * 0.13) * ahead,
        cloudy(b, {0.30f, 0.42f, 0.58f}, 0.03f, 0.1f));
  for (const double x : {-kHalf, kHalf}) {
    pole(at(x, kSeat, -kHalf), at(x, kFeet, -kHalf), kLeg);
    pole(at(x, kTop, kHalf), at(x, kFeet, kHalf), kLeg);
    pole(at(x, 0.27, -kHalf), at(x, 0.27, kHalf), kBar);
  }
  pole(at(-kHalf, 0.21, -kHalf), at(kHalf, 0.21, -kHalf), kBar);
  constexpr int kBars = 5;
  for (int i = 0; i < kBars; ++i) {
    const double x = kHalf * (2.0 * (i + 1) / (kBars + 1) - 1);
    pole(at(x, kSeat, kHalf), at(x, kTop + 0.03, kHalf), kBar);
  }
  b.box(at(0, kTop + 0.03, kHalf), (size * kHalf) * right, {0, size * 0.03, 0},
        (size * 0.012) * ahead, frame);
  const double radius = 0.1 * size;
  b.globe({0.24 * size, 0.2 * size, 1 + radius}, radius,
          b.material(Pattern::kChecks, {0.12f, 0.2f, 0.42f}, {0.42f, 0.52f, 0.66f},
                     {0.92f, 0.9f, 0.8f}, 0.06f, 0.85f));
}

}  // namespace gigaray::synthetic
