// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <array>

#include "synthetic_builder.h"
#include "synthetic_hard_scenes.h"
#include "synthetic_room_scenes.h"

namespace gigaray::synthetic {
namespace {

int stone(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.22f, 0.20f, 0.20f}, {0.58f, 0.54f, 0.49f},
                    {0.92f, 0.88f, 0.80f}, 0.16f, 0.95f);
}
int foliage(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.05f, 0.15f, 0.10f}, {0.17f, 0.33f, 0.20f},
                    {0.42f, 0.58f, 0.34f}, 0.13f, 1.0f);
}
int blossom(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.42f, 0.36f, 0.12f}, {0.76f, 0.66f, 0.22f},
                    {0.98f, 0.92f, 0.56f}, 0.07f, 1.0f);
}
int lawn(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.36f, 0.48f, 0.18f}, {0.56f, 0.68f, 0.30f},
                    {0.80f, 0.86f, 0.50f}, 0.07f, 1.0f);
}
int bricks(SceneBuilder& b, float scale) {
  return b.material(Pattern::kBricks, {0.42f, 0.38f, 0.35f}, {0.68f, 0.38f, 0.28f},
                    {0.90f, 0.62f, 0.48f}, scale, 1.1f);
}
int planks(SceneBuilder& b, float scale) {
  return b.material(Pattern::kPlanks, {0.20f, 0.13f, 0.09f}, {0.55f, 0.38f, 0.24f},
                    {0.84f, 0.66f, 0.45f}, scale, 1.1f);
}
int steel(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.10f, 0.13f, 0.17f}, {0.26f, 0.31f, 0.37f},
                    {0.52f, 0.57f, 0.62f}, 0.05f, 0.8f);
}
int bark(SceneBuilder& b) {
  return b.material(Pattern::kNoise, {0.24f, 0.15f, 0.08f}, {0.56f, 0.40f, 0.22f},
                    {0.85f, 0.70f, 0.46f}, 0.05f, 0.85f);
}
int marble(SceneBuilder& b, Colour mid, float scale) {
  const Colour dark = 0.4f * mid;
  const Colour light = 0.35f * mid + Colour{0.62f, 0.62f, 0.60f};
  return b.material(Pattern::kMarble, dark, mid, light, scale, 0.85f);
}
Colour random_colour(SceneBuilder& b) {
  return {float(b.random(0.25, 0.85)), float(b.random(0.25, 0.75)), float(b.random(0.2, 0.8))};
}

/// The nearest surface of a scene: a post at one side whose front has exactly the largest
/// disparity.
void near_post(SceneBuilder& b, double x) { b.card({x, 0.2, 1}, 0.045, 0.34, planks(b, 0.06f)); }

void build_planes(SceneBuilder& b) {
  b.backdrop(stone(b));
  b.slope({-0.32, 0, 0}, {0.5, 0, 0.34}, bricks(b, 0.22f));
  const int count = 6;
  for (int i = 0; i < count; ++i) {
    const double nearness = 0.26 + 0.1 * i;
    const Pattern pattern = i % 3 == 0   ? Pattern::kChecks
                            : i % 3 == 1 ? Pattern::kNoise
                                         : Pattern::kMarble;
    const Colour mid = random_colour(b);
    const int look = b.material(pattern, 0.35f * mid, mid, 0.4f * mid + Colour{0.55f, 0.55f, 0.5f},
                                0.07f, 0.85f);
    const Place place{-0.36 + 0.72 * (i * 5 % count) / (count - 1) + b.random(-0.03, 0.03),
                      b.random(-0.28, 0.28), nearness};
    b.card(place, b.random(0.13, 0.2), b.random(0.13, 0.2), look, b.random(-0.11, 0.11),
           b.random(-0.11, 0.11));
  }
  near_post(b, b.random(-0.1, 0.1));
}

void build_rods(SceneBuilder& b) {
  b.backdrop(bricks(b, 0.3f));
  b.slope({0, 0.16, 0}, {0, 0.5, 0.6}, planks(b, 0.16f));
  b.railing({-0.62, 0.3, 0.3}, {0.62, 0.33, 0.45}, 0.34, 19, 0.007, steel(b));
  const int wood = bark(b);
  for (int i = 0; i < 9; ++i) {
    const double x = -0.44 + 0.11 * i + b.random(-0.03, 0.03);
    const double nearness = b.random(0.5, 0.92);
    b.rod({x, 0.75, nearness}, {x + b.random(-0.12, 0.12), -0.75, nearness - b.random(0, 0.25)},
          b.random(0.005, 0.012), wood);
  }
  b.rod({-0.7, b.random(-0.35, -0.25), 0.62}, {0.7, b.random(-0.3, -0.15), 0.7}, 0.008, steel(b));
  near_post(b, b.random(0.2, 0.34));
}

void build_sphere(SceneBuilder& b) {
  b.backdrop(foliage(b));
  b.slope({0, -0.34, 0}, {0, 0.5, 0.5}, planks(b, 0.3f));
  b.ball({b.random(-0.12, -0.04), b.random(-0.08, 0.02), 1}, 0.34,
         marble(b, {0.72f, 0.45f, 0.34f}, 0.11f));
  b.ball({b.random(0.3, 0.36), b.random(0.18, 0.24), 0.72}, 0.13,
         b.material(Pattern::kChecks, {0.12f, 0.2f, 0.42f}, {0.42f, 0.52f, 0.66f},
                    {0.92f, 0.9f, 0.8f}, 0.09f, 0.85f));
}

void build_wall(SceneBuilder& b) {
  b.backdrop(b.material(Pattern::kPlain, {}, {0.80f, 0.77f, 0.70f}, {}, 1));
  b.slope({0, 0.3, 0}, {0, 0.5, 0.34}, planks(b, 0.2f));
  b.card({b.random(-0.3, -0.22), b.random(-0.2, -0.14), 0.06}, 0.17, 0.13,
         marble(b, random_colour(b), 0.1f));
  b.card({b.random(0.16, 0.22), b.random(-0.22, -0.12), 0.12}, 0.11, 0.15, foliage(b), 0.05, 0);
  b.ball({b.random(-0.1, 0.02), 0.22, 0.62}, 0.15, marble(b, random_colour(b), 0.08f));
  b.rod({0.3, 0.42, 0.5}, {b.random(0.33, 0.4), -0.34, 0.44}, 0.009, bark(b));
  near_post(b, b.random(-0.42, -0.36));
}

void build_specular(SceneBuilder& b) {
  b.backdrop(stone(b));
  b.slope({0, 0.1, 0}, {0, 0.5, 0.6}, planks(b, 0.2f));
  const int panel = marble(b, {0.30f, 0.22f, 0.46f}, 0.16f);
  const Place middle{b.random(-0.14, -0.08), b.random(-0.1, -0.04), 0.4};
  b.card(middle, 0.34, 0.28, panel, 0.09, 0);
  b.add_gloss(panel, {middle.x + 0.04, middle.y - 0.03, 0.41}, b.last_normal(), 0.92f, 8);
  const int glaze = b.material(Pattern::kChecks, {0.35f, 0.1f, 0.1f}, {0.66f, 0.22f, 0.18f},
                               {0.9f, 0.6f, 0.4f}, 0.08f, 0.8f);
  const Place ball{b.random(0.26, 0.32), 0.16, 0.82};
  b.ball(ball, 0.18, glaze);
  b.add_gloss(glaze, ball, {-0.25, -0.4, -1}, 0.85f, 6);
  near_post(b, b.random(-0.46, -0.4));
}

/// Everything in one picture: lawn, hedge and house are slanted planes; a railing, stakes and stems
/// are thin; balls are curved; the plaster has no texture; the window and a ball shine.
void build_garden(SceneBuilder& b) {
  b.backdrop(foliage(b));
  const double horizon = 0.04, lawn_end = 0.82;
  const auto lawn_y = [&](double nearness) {
    return horizon + (0.5 - horizon) * nearness / lawn_end;
  };
  b.slope({0, horizon, 0}, {0, 0.5, lawn_end}, lawn(b));

  const double corner = 0.04, house_rise = 0.62;
  const auto on_house = [&](double x, double y, double thickness) {
    return Place{x, y, (x - corner) * house_rise + thickness};
  };
  const auto fixture = [&](Place place, double half_x, double half_y, int look) {
    b.card(place, half_x, half_y, look, half_x * b.height_over_width() * house_rise);
  };
  b.slope({corner, 0, 0}, {corner + 1, 0, house_rise}, bricks(b, 0.16f));
  fixture(on_house(0.36, -0.2, 0.004), 0.19, 0.24,
          b.material(Pattern::kPlain, {}, {0.90f, 0.86f, 0.76f}, {}, 1));
  fixture(on_house(0.14, -0.21, 0.004), 0.085, 0.125, planks(b, 0.05f));
  const int pane = b.material(Pattern::kNoise, {0.10f, 0.16f, 0.24f}, {0.17f, 0.25f, 0.35f},
                              {0.28f, 0.38f, 0.48f}, 0.1f, 0.7f);
  const Place window = on_house(0.14, -0.21, 0.01);
  fixture(window, 0.068, 0.105, pane);
  b.add_gloss(pane, window, b.last_normal(), 0.9f, 9);

  const int wood = bark(b);
  b.rod({-0.33, lawn_y(0.2), 0.2}, {-0.31, -0.26, 0.2}, 0.022, wood);
  const int leaves = blossom(b);
  for (const auto& [x, y, radius] : {std::array{-0.40, -0.27, 0.13}, std::array{-0.27, -0.34, 0.15},
                                     std::array{-0.21, -0.23, 0.10}})
    b.ball({x, y, 0.2 + b.random(0, 0.04)}, radius, leaves);

  b.railing({-0.64, lawn_y(0.36), 0.36}, {0.2, lawn_y(0.3), 0.3}, 0.2, 18, 0.006, steel(b));
  b.card({-0.05, 0.12, 0.44}, 0.12, 0.15, marble(b, {0.35f, 0.48f, 0.62f}, 0.09f), 0.12, 0);
  b.ball({b.random(0.24, 0.28), 0.2, 0.6}, 0.14,
         b.material(Pattern::kChecks, {0.62f, 0.14f, 0.12f}, {0.86f, 0.55f, 0.40f},
                    {0.98f, 0.93f, 0.80f}, 0.075f, 0.9f));
  const int glaze = marble(b, {0.24f, 0.34f, 0.62f}, 0.08f);
  b.ball({-0.28, 0.27, 0.7}, 0.1, glaze);
  b.add_gloss(glaze, {-0.3, 0.2, 0.7}, {-0.1, -0.35, -1}, 0.85f, 6);

  const int stem = foliage(b);
  const Colour petals[] = {{0.93f, 0.72f, 0.18f}, {0.86f, 0.32f, 0.42f}, {0.80f, 0.62f, 0.90f}};
  for (int i = 0; i < 5; ++i) {
    const double nearness = i == 2 ? 1 : b.random(0.84, 0.95);
    const double x = -0.44 + 0.2 * i + b.random(-0.04, 0.04), y = b.random(0.06, 0.26);
    const Place head{x, y, nearness};
    b.rod({x + b.random(-0.05, 0.05), 0.8, nearness - 0.06}, {x, y, nearness - 0.03}, 0.006, stem);
    const Colour petal = petals[i % 3];
    b.disc(head, 0.055, 0.05,
           b.material(Pattern::kNoise, 0.55f * petal, petal,
                      0.5f * petal + Colour{0.5f, 0.5f, 0.5f}, 0.04f, 0.9f));
  }
}

}  // namespace

Scene build_scene(const SyntheticOptions& options) {
  SceneBuilder builder(options);
  if (options.scene == "planes") build_planes(builder);
  if (options.scene == "rods") build_rods(builder);
  if (options.scene == "sphere") build_sphere(builder);
  if (options.scene == "wall") build_wall(builder);
  if (options.scene == "specular") build_specular(builder);
  if (options.scene == "plaster") build_plaster(builder);
  if (options.scene == "silhouettes") build_silhouettes(builder);
  if (options.scene == "wedges") build_wedges(builder);
  if (options.scene == "room") build_room(builder);
  if (options.scene == "figure") build_figure(builder);
  if (options.scene == "garden") build_garden(builder);
  return builder.finish();
}

}  // namespace gigaray::synthetic
