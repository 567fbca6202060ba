// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace gigaray {

/// A lens as COLMAP describes it: one of its camera models and the parameters in COLMAP's order,
/// for a picture of width x height px whose first pixel has its centre at (0.5, 0.5).
struct Lens {
  std::string model;  ///< "PINHOLE", "OPENCV", "OPENCV_FISHEYE", …: see lens_models()
  int width = 0, height = 0;
  std::vector<double> params;
};

/// Names of the models that are known: all of COLMAP 3.8 – 3.12.
const std::vector<std::string>& lens_models();

/// Throws Error(kBadInput), beginning with `where`, for an unknown model, a wrong number of
/// parameters, parameters that are not finite, sizes or focal lengths that are not positive or
/// absurd.
void check(const Lens& lens, const std::string& where);

/// Where the lens shows a direction (x / z, y / z) of the camera, px with pixel centres at
/// integers (gigaray::Camera's convention). Empty where the model maps nothing (beyond its field).
std::optional<Eigen::Vector2d> distort(const Lens& lens, const Eigen::Vector2d& direction);

/// The inverse of distort; empty where the iteration finds none.
std::optional<Eigen::Vector2d> undistort(const Lens& lens, const Eigen::Vector2d& pixel);

/// Are all distortion parameters 0?
bool is_pinhole(const Lens& lens);

}  // namespace gigaray
