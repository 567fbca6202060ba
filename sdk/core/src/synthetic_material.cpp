// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>

#include "synthetic_noise.h"
#include "synthetic_scene.h"

namespace gigaray::synthetic {
namespace {

/// Towards the one lamp of all scenes: from above, left and behind the viewer.
const Vec3f kLampDirection = normalised(Vec3f{-0.45f, -0.75f, -0.62f});
constexpr float kAmbient = 0.52f;

Colour mixed(Colour a, Colour b, float k) { return a + k * (b - a); }

/// dark … mid … light for -1 … 0 … 1.
Colour palette(const Material& m, float x) {
  x = std::clamp(x, -1.0f, 1.0f);
  return x < 0 ? mixed(m.mid, m.dark, -x) : mixed(m.mid, m.light, x);
}

/// 0 below -half_width, 1 above +half_width, smooth between.
float soft_step(float x, float half_width) {
  const float k = std::clamp(0.5f + 0.5f * x / half_width, 0.0f, 1.0f);
  return k * k * (3 - 2 * k);
}

/// Distance to the nearest multiple of `period`, and which cell that leaves us in.
struct Cell {
  int index;
  float edge_distance;
};
Cell cell_of(float x, float period) {
  const int k = floor_to_int(x / period);
  const float inside = x - float(k) * period;
  return {k, std::min(inside, period - inside)};
}

float cell_tone(int i, int j, std::uint32_t seed) {
  return float(
      uniform(hash(seed, std::uint64_t(std::int64_t(i)), std::uint64_t(std::int64_t(j))), -1, 1));
}

/// Bricks (or planks, when a row is one endless board): tone per piece, grain, dark joints.
Colour masonry(const Material& m, Vec3f p, float row_height, float piece_length, float joint,
               float grain, float footprint) {
  const Cell row = cell_of(p.y, row_height);
  const float shift = 0.5f * float(row.index & 1) * piece_length;
  const Cell piece = cell_of(p.x + shift, piece_length);
  const float blur = std::max(0.25f * joint, 1.2f * footprint);
  const float edge = std::min(row.edge_distance, piece.edge_distance);
  // The tone fades out towards the joint, so that it has no step of its own there.
  const float body = soft_step(edge - 0.5f * joint, blur);
  const float tone = 0.45f * cell_tone(row.index, piece.index, m.seed) + 0.55f * grain;
  return mixed(m.dark, palette(m, 0.4f + 0.6f * tone), body);
}

Colour texture(const Material& m, Vec3f p, float footprint) {
  if (m.pattern == Pattern::kPlain) return m.mid;
  const float noise = fractal_noise(p, m.scale, m.persistence, m.seed, footprint);
  switch (m.pattern) {
    case Pattern::kBricks:
      return masonry(m, p, 0.42f * m.scale, m.scale, 0.07f * m.scale, noise, footprint);
    case Pattern::kPlanks:
      return masonry(m, p, 0.5f * m.scale, 7 * m.scale, 0.05f * m.scale, noise, footprint);
    case Pattern::kMarble: {
      const float wave = p.y / m.scale + 0.35f * noise;
      const float phase = wave - float(floor_to_int(wave));
      const float hill = 4 * phase * (1 - phase);
      return palette(m, 2 * hill - 1 + 0.25f * noise);
    }
    case Pattern::kChecks: {
      const Cell a = cell_of(p.x, m.scale);
      const Cell b = cell_of(p.y, m.scale);
      const float blur = 1.2f * footprint;
      const float side = ((a.index + b.index) & 1) ? -1.0f : 1.0f;
      const float sharp =
          (2 * soft_step(a.edge_distance, blur) - 1) * (2 * soft_step(b.edge_distance, blur) - 1);
      return palette(m, 0.75f * side * std::max(0.0f, sharp) + 0.3f * noise);
    }
    default:
      return palette(m, 0.8f * noise);
  }
}

float power_of_two_power(float x, int exponent) {
  for (int i = 0; i < exponent; ++i) x *= x;
  return x;
}

}  // namespace

Colour shade(const Material& material, Vec3f p, Vec3f normal, Vec3f to_viewer, float footprint) {
  if (material.is_void) return material.mid;
  const float diffuse = std::max(0.0f, dot(normal, kLampDirection));
  Colour colour = (kAmbient + (1.08f - kAmbient) * diffuse) * texture(material, p, footprint);
  if (material.gloss > 0) {
    const Vec3f mirrored = 2 * dot(normal, to_viewer) * normal - to_viewer;
    const float cosine = std::max(0.0f, dot(mirrored, material.gloss_direction));
    const float highlight = material.gloss * power_of_two_power(cosine, material.gloss_power);
    colour = mixed(colour, Colour{1, 1, 0.97f}, highlight);
  }
  return colour;
}

}  // namespace gigaray::synthetic
