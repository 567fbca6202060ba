// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "synthetic_noise.h"

#include <algorithm>
#include <array>

namespace gigaray::synthetic {
namespace {

constexpr int kMaxOctaves = 9;
/// Standard deviation of one octave of gradient noise with edge-centred gradients (measured).
constexpr float kOctaveDeviation = 0.27f;

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// A shuffle of 0 … 255, twice in a row so that a sum of two entries needs no wrapping.
constexpr std::array<std::uint8_t, 512> make_shuffle() {
  std::array<std::uint8_t, 512> table{};
  for (int i = 0; i < 256; ++i) table[i] = std::uint8_t(i);
  for (int i = 255; i > 0; --i) {
    const int j = int(mix(std::uint64_t(i)) % std::uint64_t(i + 1));
    const std::uint8_t other = table[j];
    table[j] = table[i];
    table[i] = other;
  }
  for (int i = 0; i < 256; ++i) table[256 + i] = table[i];
  return table;
}
constexpr std::array<std::uint8_t, 512> kShuffle = make_shuffle();

/// Middles of the twelve edges of a cube, four of them twice to make sixteen (Perlin 2002).
constexpr Vec3f kGradients[16] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, -1, -1}};

constexpr Vec3f kPlanarGradients[8] = {{1, 0, 0},          {-1, 0, 0},         {0, 1, 0},
                                       {0, -1, 0},         {0.71f, 0.71f, 0},  {-0.71f, 0.71f, 0},
                                       {0.71f, -0.71f, 0}, {-0.71f, -0.71f, 0}};

float fade(float x) { return x * x * x * (x * (x * 6 - 15) + 10); }
float lerp(float a, float b, float k) { return a + k * (b - a); }

/// The same in the plane z = 0, where only four corners count.
float planar_gradient_noise(Vec3f p) {
  const int ix = floor_to_int(p.x), iy = floor_to_int(p.y);
  const float x = p.x - float(ix), y = p.y - float(iy);
  const auto corner = [&](int dx, int dy) {
    const int h = kShuffle[kShuffle[(ix + dx) & 255] + ((iy + dy) & 255)];
    const Vec3f g = kPlanarGradients[h & 7];
    return g.x * (x - float(dx)) + g.y * (y - float(dy));
  };
  const float kx = fade(x), ky = fade(y);
  return lerp(lerp(corner(0, 0), corner(1, 0), kx), lerp(corner(0, 1), corner(1, 1), kx), ky);
}

float gradient_noise(Vec3f p) {
  const int ix = floor_to_int(p.x), iy = floor_to_int(p.y), iz = floor_to_int(p.z);
  const float x = p.x - float(ix), y = p.y - float(iy), z = p.z - float(iz);
  const auto corner = [&](int dx, int dy, int dz) {
    const int h =
        kShuffle[kShuffle[kShuffle[(ix + dx) & 255] + ((iy + dy) & 255)] + ((iz + dz) & 255)];
    return dot(kGradients[h & 15], Vec3f{x - float(dx), y - float(dy), z - float(dz)});
  };
  const float kx = fade(x), ky = fade(y), kz = fade(z);
  const float front = lerp(lerp(corner(0, 0, 0), corner(1, 0, 0), kx),
                           lerp(corner(0, 1, 0), corner(1, 1, 0), kx), ky);
  const float back = lerp(lerp(corner(0, 0, 1), corner(1, 0, 1), kx),
                          lerp(corner(0, 1, 1), corner(1, 1, 1), kx), ky);
  return lerp(front, back, kz);
}

}  // namespace

std::uint64_t hash(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mix(mix(mix(a) ^ b) ^ c);
}

double uniform(std::uint64_t bits, double low, double high) {
  return low + (high - low) * (double(bits >> 11) * 0x1p-53);
}

float gaussian(std::uint64_t key) {
  constexpr int kTerms = 16;
  constexpr float kMean = kTerms * 65535.0f / 2;
  constexpr float kDeviation = 75674.31f;  // sqrt(kTerms * (65536^2 - 1) / 12)
  std::uint32_t sum = 0;
  for (int i = 0; i < kTerms / 4; ++i) {
    const std::uint64_t bits = mix(key + std::uint64_t(i) * 0xd1342543de82ef95u);
    sum += std::uint32_t(bits & 0xffff) + std::uint32_t((bits >> 16) & 0xffff) +
           std::uint32_t((bits >> 32) & 0xffff) + std::uint32_t(bits >> 48);
  }
  return (float(sum) - kMean) / kDeviation;
}

float fractal_noise(Vec3f p, float scale, float persistence, std::uint32_t seed, float footprint) {
  const bool is_planar = p.z == 0;
  // Each seed and octave looks at another part of the one infinite pattern.
  const float shift = float(seed % 8191u) * 0.37f;
  float wavelength = scale, amplitude = 1, sum = 0, power = 0;
  for (int octave = 0; octave < kMaxOctaves; ++octave) {
    const float weight = amplitude * std::clamp(wavelength / footprint - 2, 0.0f, 1.0f);
    if (weight <= 0) break;
    const float step = 17.3f * float(octave);
    const float k = 1 / wavelength;
    const Vec3f q{k * p.x + shift + step, k * p.y + shift * 0.71f - step,
                  k * p.z + shift * 0.43f + step};
    sum += weight * (is_planar ? planar_gradient_noise(q) : gradient_noise(q));
    power += weight * weight;
    amplitude *= persistence;
    wavelength *= 0.5f;
  }
  if (power <= 0) return 0;
  return std::clamp(sum / (kOctaveDeviation * std::sqrt(power)), -1.5f, 1.5f);
}

}  // namespace gigaray::synthetic
