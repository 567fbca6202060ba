// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "synthetic_hard_scenes.h"

#include <cmath>

namespace gigaray::synthetic {
namespace {

/// Noise around a colour, `contrast` to either side.
int speckled(SceneBuilder& b, Colour mid, float contrast, float scale) {
  const Colour step{contrast, contrast, contrast};
  return b.material(Pattern::kNoise, mid - step, mid, mid + step, scale, 0.9f);
}

int boards(SceneBuilder& b) {
  return b.material(Pattern::kPlanks, {0.22f, 0.15f, 0.10f}, {0.52f, 0.38f, 0.26f},
                    {0.80f, 0.64f, 0.46f}, 0.14f, 1.0f);
}

int poster(SceneBuilder& b, Colour mid) {
  return b.material(Pattern::kMarble, 0.35f * mid, mid, 0.4f * mid + Colour{0.55f, 0.55f, 0.52f},
                    0.07f, 0.9f);
}

}  // namespace

/// The left wall has no texture at all, the right one about a grey level of it, as walls in
/// daylight have. Both are bounded by textured things: the floor, the end of the corridor, what
/// hangs there.
void build_plaster(SceneBuilder& b) {
  b.backdrop(poster(b, {0.45f, 0.55f, 0.62f}));
  b.slope({0, 0.14, 0}, {0, 0.5, 0.6}, boards(b));
  const double corner = 0.12, rise = 1.6;
  const auto on_wall = [&](double x, double y) {
    return Place{x, y, (std::abs(x) - corner) * rise + 0.006};
  };
  const auto fixture = [&](double x, double y, double half_x, double half_y, int look) {
    const double slope = half_x * b.height_over_width() * rise;
    b.card(on_wall(x, y), half_x, half_y, look, x < 0 ? -slope : slope);
  };
  b.slope({-corner, 0, 0}, {-corner - 0.25, 0, 0.25 * rise},
          b.material(Pattern::kPlain, {}, {0.82f, 0.79f, 0.72f}, {}, 1));
  b.slope({corner, 0, 0}, {corner + 0.25, 0, 0.25 * rise},
          speckled(b, {0.74f, 0.76f, 0.78f}, 0.006f, 0.1f));
  fixture(-0.34, -0.16, 0.07, 0.16, poster(b, {0.62f, 0.36f, 0.30f}));
  fixture(0.33, -0.12, 0.06, 0.13, poster(b, {0.34f, 0.50f, 0.36f}));
  b.ball({b.random(-0.08, 0.0), 0.26, 0.5}, 0.11, poster(b, {0.66f, 0.58f, 0.30f}));
  b.card({b.random(0.1, 0.16), 0.3, 1}, 0.035, 0.3, boards(b));
}

/// Boards, discs and bars of the colours and the texture of the wall behind them, at most three
/// grey levels off: only parallax tells them apart.
void build_silhouettes(SceneBuilder& b) {
  const Colour mid{0.50f, 0.47f, 0.42f};
  constexpr float kContrast = 0.16f, kScale = 0.07f;
  const auto alike = [&] {
    const float tone = float(b.random(-0.012, 0.012));
    return speckled(b, mid + Colour{tone, tone, tone}, kContrast, kScale);
  };
  b.backdrop(alike());
  for (int i = 0; i < 3; ++i)
    b.disc({-0.3 + 0.3 * i, b.random(-0.26, -0.18), 0.2 + 0.15 * i}, 0.13, 0.16, alike());
  b.card({b.random(-0.34, -0.28), 0.22, 0.55}, 0.16, 0.2, alike(), 0.12, 0);
  for (int i = 0; i < 4; ++i) b.card({0.0 + 0.055 * i, 0.18, 0.62 + 0.06 * i}, 0.014, 0.3, alike());
  b.card({b.random(0.33, 0.37), 0.14, 1}, 0.11, 0.17, alike());
}

/// Wedges hang from the upper and stand on the lower rim. Their tips are thinner than a pixel; the
/// step to the plane behind them grows from the bottom to the top.
void build_wedges(SceneBuilder& b) {
  b.backdrop(speckled(b, {0.44f, 0.50f, 0.58f}, 0.34f, 0.08f));
  b.slope({0, -0.3, 0}, {0, 0.5, 0.5}, speckled(b, {0.56f, 0.50f, 0.42f}, 0.34f, 0.08f));
  constexpr int kPairs = 7;
  for (int i = 0; i < kPairs; ++i) {
    const double x = -0.42 + 0.84 * i / (kPairs - 1);
    const double half = 0.05 - 0.005 * i;
    const double nearness = i == 0 ? 1 : 0.95 - 0.05 * i;
    b.wedge({x, 0.36, nearness}, -0.6, half, speckled(b, {0.62f, 0.40f, 0.34f}, 0.28f, 0.06f));
    b.wedge({x + 0.07, -0.3, nearness - 0.08}, 0.6, half,
            speckled(b, {0.38f, 0.54f, 0.40f}, 0.28f, 0.06f));
  }
}

}  // namespace gigaray::synthetic
