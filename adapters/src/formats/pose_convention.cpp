// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pose_convention.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "files/text.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

constexpr const char* kToCamera = "-w2c";
constexpr const char* kToScene = "-c2w";

/// Names in use and their axes. The order is that of all_pose_conventions().
constexpr std::array<std::pair<const char*, const char*>, 6> kNamed{{{"opencv", "RDF"},
                                                                     {"opengl", "RUB"},
                                                                     {"unity", "RUF"},
                                                                     {"llff", "DRB"},
                                                                     {"ros", "FLU"},
                                                                     {"unreal", "FRU"}}};

/// The direction of a letter in the camera of camera.h: right, down, ahead.
std::optional<Eigen::Vector3d> direction_of(char letter) {
  switch (letter) {
    case 'R':
      return Eigen::Vector3d::UnitX();
    case 'L':
      return -Eigen::Vector3d::UnitX();
    case 'D':
      return Eigen::Vector3d::UnitY();
    case 'U':
      return -Eigen::Vector3d::UnitY();
    case 'F':
      return Eigen::Vector3d::UnitZ();
    case 'B':
      return -Eigen::Vector3d::UnitZ();
  }
  return std::nullopt;
}

/// Its columns are x, y and z of the convention in the camera of camera.h. Empty: they are none.
std::optional<Eigen::Matrix3d> axes_of(std::string_view letters) {
  if (letters.size() != 3) return std::nullopt;
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) {
    const auto direction = direction_of(letters[std::size_t(i)]);
    if (!direction) return std::nullopt;
    axes.col(i) = *direction;
  }
  if (axes.determinant() == 0) return std::nullopt;  // two along one line
  return axes;
}

std::string word_of(char letter) {
  switch (letter) {
    case 'R':
      return "right";
    case 'L':
      return "left";
    case 'D':
      return "down";
    case 'U':
      return "up";
    case 'F':
      return "forward";
    default:
      return "back";
  }
}

Eigen::Matrix3d axes_stated(const PoseConvention& convention) {
  const auto axes = axes_of(convention.axes);
  require_argument(axes.has_value(), "convention.axes: names no axes; RDF, RUB, DRB, … do");
  return *axes;
}

}  // namespace

std::optional<PoseConvention> parse_pose_convention(std::string_view text) {
  std::string word = lower(std::string(text));
  PoseConvention convention;
  convention.scene_to_camera = word.ends_with(kToCamera);
  if (convention.scene_to_camera || word.ends_with(kToScene)) word.resize(word.size() - 4);
  for (const auto& [name, axes] : kNamed)
    if (word == name) {
      convention.axes = axes;
      return convention;
    }
  convention.axes = upper(word);
  if (!axes_of(convention.axes)) return std::nullopt;
  return convention;
}

std::string name_of(const PoseConvention& convention) {
  std::string name = convention.axes;
  for (const auto& [known, axes] : kNamed)
    if (convention.axes == axes) name = known;
  return name + (convention.scene_to_camera ? kToCamera : "");
}

std::string describe(const PoseConvention& convention) {
  axes_stated(convention);
  std::string text = name_of(convention) + " (";
  text += convention.scene_to_camera ? "scene to camera" : "camera to scene";
  constexpr const char* kAxes[] = {"; x ", ", y ", ", z "};
  for (std::size_t i = 0; i < 3; ++i) text += kAxes[i] + word_of(convention.axes[i]);
  return text + ")";
}

std::vector<PoseConvention> all_pose_conventions() {
  std::vector<std::string> orders;
  for (const auto& [name, axes] : kNamed) orders.emplace_back(axes);
  const std::string letters = "RLDUFB";
  for (const char x : letters)
    for (const char y : letters)
      for (const char z : letters) {
        const std::string axes{x, y, z};
        if (axes_of(axes) && std::ranges::find(orders, axes) == orders.end())
          orders.push_back(axes);
      }
  std::vector<PoseConvention> all;
  for (std::size_t i = 0; i < orders.size(); ++i)
    for (const bool scene_to_camera : {false, true}) all.push_back({orders[i], scene_to_camera});
  return all;
}

std::optional<CameraPose> read_pose(const StatedPose& stated, const PoseConvention& convention) {
  constexpr double kRounding = 1e-3;
  if (!stated.allFinite()) return std::nullopt;
  const Eigen::Matrix3d axes = axes_stated(convention);
  const double scale = std::cbrt(std::abs(stated.leftCols<3>().determinant()));
  if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
  const Eigen::Matrix3d unit = stated.leftCols<3>() / scale;
  const Eigen::Matrix3d square = unit * unit.transpose();
  if ((square - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kRounding) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(unit, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d orthogonal = svd.matrixU() * svd.matrixV().transpose();

  CameraPose pose;
  Eigen::Vector3d position = stated.col(3);
  if (convention.scene_to_camera) {
    pose.rotation = axes * orthogonal;
    position = -orthogonal.transpose() * (stated.col(3) / scale);
  } else {
    pose.rotation = axes * orthogonal.transpose();
  }
  pose.is_mirrored = pose.rotation.determinant() < 0;
  if (pose.is_mirrored) {
    pose.rotation.col(2) *= -1;
    position.z() *= -1;
  }
  pose.translation = -pose.rotation * position;
  return pose;
}

StatedPose state_pose(const CameraPose& pose, const PoseConvention& convention) {
  const Eigen::Matrix3d axes = axes_stated(convention);
  Eigen::Matrix3d rotation = pose.rotation;
  Eigen::Vector3d position = -rotation.transpose() * pose.translation;
  if (pose.is_mirrored) {
    rotation.col(2) *= -1;
    position.z() *= -1;
  }
  StatedPose stated;
  if (convention.scene_to_camera)
    stated << axes.transpose() * rotation, -axes.transpose() * rotation * position;
  else
    stated << rotation.transpose() * axes, position;
  return stated;
}

}  // namespace gigaray
