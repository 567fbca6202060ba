// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "synthetic_vec.h"

namespace gigaray::synthetic {

/// A well-mixed 64-bit value of a key; the only source of randomness of the synthetic scenes. It is
/// addressed by what it is for, not by when it is drawn, so no order of execution can change it.
std::uint64_t hash(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);

/// Uniform in [low, high), from the upper bits of a hash.
double uniform(std::uint64_t bits, double low = 0, double high = 1);

/// Zero mean, unit variance. A sum of sixteen uniform values, which is bell-shaped to an excess
/// kurtosis of -0.075 and needs no transcendental function (they differ between C libraries).
float gaussian(std::uint64_t key);

inline int floor_to_int(float x) {
  const int i = int(x);
  return i - (x < float(i));
}

/// Smooth noise of about unit variance, clipped to [-1.5, 1.5]: gradient noise in octaves from
/// wavelength `scale` down to three footprints (the size of a pixel at that place), below which
/// nothing is left that could alias. `persistence` is the amplitude of an octave over the one
/// before. Points with z = 0 exactly belong to a planar texture of its own, at half the cost.
float fractal_noise(Vec3f p, float scale, float persistence, std::uint32_t seed, float footprint);

}  // namespace gigaray::synthetic
