// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"
#include "gigaray/core/run_control.h"
#include "gigaray/core/synthetic.h"

namespace GIGARAY_API gigaray {

/// How the camera goes past a synthetic scene, whose surfaces lie between the depths 1 and 2.5 of
/// the middle camera, those of "room" and "figure" between 1 and 4. The middle of a scene has half
/// of the sum of the inverse depths.
struct SyntheticPath {
  enum class Shape {
    kLine,  ///< along a straight line to the right, looking ahead: a rail
    kArc,   ///< along a circle around the middle of the scene, looking at it
    kWalk,  ///< to the right, up and down, to and fro, looking at the middle: from the hand
  };
  static constexpr double kWidestStepDeg = 20;
  Shape shape = Shape::kWalk;
  double extent = 0.5;  ///< between the first and the last camera, scene units, > 0 … 2
  /// Angle between neighbouring cameras as seen from the middle of the scene, degrees, 0 … 20. 0:
  /// extent says it. Else the path is an arc around the middle, which a walk leaves up and down, to
  /// and fro, and extent isn't used; all steps together may be 90°, in "room" 120°, around "figure"
  /// 360°. Not for a line.
  double step = 0;
  double spacing_noise = 0;   ///< standard deviation over the mean spacing, 0 … 0.3
  double off_line = 0;        ///< of the positions beside the path, scene units, 0 … 0.1
  double rotation_noise = 0;  ///< standard deviation about each axis, degrees, 0 … 10
  /// Standard deviation of the exposure, stops, 0 … 1: a gain of 2^stops in linear light, which is
  /// 2^(stops / 2.2) of the encoded value, before noise and clipping.
  double exposure_noise = 0;
  double distortion = 0;  ///< k1 of COLMAP's SIMPLE_RADIAL, (x, y) (1 + k1 r²); -0.2 … 0.2

  void check() const;  ///< Throws Error(kInvalidArgument) naming the field and its value.
};

/// What is known of a capture without its pictures.
struct SyntheticCapture {
  struct Sight {
    int view_idx = 0;
    Eigen::Vector2d pixel;  ///< px, in the picture as taken, pixel centres at integers
  };
  /// A place on a surface and the views that see it, two or more.
  struct Point {
    Eigen::Vector3d position;
    std::array<std::uint8_t, 3> rgb{};
    std::vector<Sight> sights;
  };

  std::vector<std::string> names;  ///< "view_007", in the order of the path
  std::vector<Camera> cameras;     ///< without the distortion
  std::vector<double> exposures;   ///< stops above what the scene's colours say
  std::vector<Point> points;       ///< spread over what the views see
};

/// Takes one finished view. depth: z in the camera, scene units, exact for the ray of each pixel's
/// centre; infinite on the white around "figure", else finite. Called from several threads at once,
/// in any order.
using SyntheticPhotographSink =
    std::function<void(int view_idx, Image<std::uint16_t> picture, FloatMap depth)>;

/// Cameras and surface points of options.views_s photographs along the path; options.views_t must
/// be 1, options.disparity isn't used. Throws Error(kInvalidArgument).
SyntheticCapture describe_synthetic_capture(const SyntheticOptions& options,
                                            const SyntheticPath& path);

/// Renders the photographs on all cores and keeps none. An exception of the sink stops the run and
/// is thrown again.
void render_synthetic_capture(const SyntheticOptions& options, const SyntheticPath& path,
                              const RunControl& control, const SyntheticPhotographSink& sink);

}  // namespace gigaray
