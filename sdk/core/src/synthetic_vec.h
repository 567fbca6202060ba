// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cmath>

namespace gigaray::synthetic {

/// A vector in scene space: x right, y down, z into the scene.
template <class T>
struct Vec3 {
  T x = 0, y = 0, z = 0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(T k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend constexpr T dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Vec3 normalised(Vec3 a) { return (T(1) / std::sqrt(dot(a, a))) * a; }
};

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

inline Vec3f to_float(Vec3d a) { return {float(a.x), float(a.y), float(a.z)}; }

}  // namespace gigaray::synthetic
