// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// How a file means its matrices of poses.
struct PoseConvention {
  /// Where the camera's x, y and z point, as one who looks through it sees them: Right or Left, Up
  /// or Down, Forward or Back. RDF: OpenCV, COLMAP; RUB: OpenGL, Blender; DRB: LLFF; RUF: Unity.
  std::string axes = "RDF";
  bool scene_to_camera = false;  ///< the matrix takes points of the scene to the camera
  bool operator==(const PoseConvention&) const = default;
};

/// "opencv", "opengl", "llff", "unity", "unreal", "ros" or three letters of PoseConvention::axes,
/// with "-w2c" behind it for scene → camera ("-c2w" says the other). Upper or lower case. Empty:
/// none of these.
std::optional<PoseConvention> parse_pose_convention(std::string_view text);

/// The text that parse_pose_convention reads: "opengl-w2c", "FLU".
std::string name_of(const PoseConvention& convention);

/// What it is, in words: "opengl-w2c (scene to camera; x right, y up, z back)".
std::string describe(const PoseConvention& convention);

/// All there are: 48 orders of axes, both ways; those in use first.
std::vector<PoseConvention> all_pose_conventions();

/// Rows of a matrix as a file states it.
using StatedPose = Eigen::Matrix<double, 3, 4>;

/// Scene → camera in the convention of camera.h.
struct CameraPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  /// The frames are left-handed in the scene or in the camera: z of the scene is turned around.
  bool is_mirrored = false;
};

/// Reads a stated matrix. Axes that are scaled alike are made unit, rounding (1e-3) is made good.
/// Empty: they are not orthogonal, of different lengths, or not finite.
std::optional<CameraPose> read_pose(const StatedPose& stated, const PoseConvention& convention);

/// The matrix that read_pose reads as `pose`.
StatedPose state_pose(const CameraPose& pose, const PoseConvention& convention);

}  // namespace gigaray
