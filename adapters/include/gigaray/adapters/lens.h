// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"

namespace GIGARAY_API gigaray {

/// A lens as COLMAP describes it: one of its camera models and the parameters in COLMAP's order,
/// for a picture of width x height px whose first pixel has its centre at (0.5, 0.5).
struct Lens {
  std::string model;  ///< "PINHOLE", "OPENCV", "OPENCV_FISHEYE", …: see lens_models()
  int width = 0, height = 0;
  std::vector<double> params;
  bool operator==(const Lens&) const = default;
};

/// Names of the models that are known, all of COLMAP 3.8 – 4 but the panorama EQUIRECTANGULAR, in
/// the order of COLMAP's numbers for them: lens_models()[4] is "OPENCV".
const std::vector<std::string>& lens_models();

/// How many parameters a model has; 0 for an unknown one.
int num_lens_params(const std::string& model);

/// Throws Error(kBadInput), beginning with `where`, for an unknown model, a wrong number of
/// parameters, parameters that are not finite, sizes or focal lengths that are not positive or
/// absurd.
void check(const Lens& lens, const std::string& where);

/// A SIMPLE_PINHOLE with its principal point in the middle of the picture. focal: px.
Lens centred_pinhole(int width, int height, double focal);

/// The lens, a PINHOLE, of a camera without distortion.
Lens pinhole_lens(const Camera& camera);

/// Where the lens shows a direction (x / z, y / z) of the camera, px with pixel centres at
/// integers (gigaray::Camera's convention). Empty where the model maps nothing (beyond its field).
std::optional<Eigen::Vector2d> distort(const Lens& lens, const Eigen::Vector2d& direction);

/// The inverse of distort; empty where the iteration finds none.
std::optional<Eigen::Vector2d> undistort(const Lens& lens, const Eigen::Vector2d& pixel);

/// Does the lens map as a pinhole does: all distortion parameters 0, and no fisheye model?
bool is_pinhole(const Lens& lens);

/// A lens made ready for many points; distort() and undistort() above are for one.
class LensMap {
 public:
  explicit LensMap(const Lens& lens);  ///< one that passes check()
  /// For a picture of width x height px instead of the lens's own size.
  LensMap(const Lens& lens, int width, int height);

  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& direction) const;
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& pixel) const;

  const Eigen::Vector2d& focal() const { return focal_; }    ///< px
  const Eigen::Vector2d& centre() const { return centre_; }  ///< px, pixel centres at integers

 private:
  enum class Projection { kPerspective, kFisheye, kFieldOfView, kDivision, kUnified };

  void set_distortion(const Lens& lens);
  void find_limit();
  double radial(double r) const;
  template <class T>
  void bend(const T& x, const T& y, T& u, T& v) const;
  // What a position at the distance √square from the principal point is divided by to become a
  // direction; 0 or less: the lens shows nothing there.
  double ahead_of_divided(double square) const;
  double ahead_of_unified(double square) const;
  std::optional<Eigen::Vector2d> unbend(const Eigen::Vector2d& seen) const;

  Projection projection_ = Projection::kPerspective;
  Eigen::Vector2d focal_, centre_;
  // Radial: (1 + Σ above_[i] r^(2i+2)) / (1 + Σ below_[i] r^(2i+2)).
  std::array<double, 6> above_{};
  std::array<double, 3> below_{};
  double p1_ = 0, p2_ = 0;           // tangential, as OpenCV names them
  std::array<double, 4> prism_{};    // of r² and r⁴ in u, then in v
  bool radial_comes_first_ = false;  // tangential and prism parts of what the radial one gives
  double field_of_view_ = 0;         // ω of the model FOV, radians
  double division_ = 0;              // k of the division models
  double alpha_ = 0, beta_ = 1;      // of EUCM
  double limit_ = 0;                 // radius up to which the radial part rises
};

}  // namespace gigaray
