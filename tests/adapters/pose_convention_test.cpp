// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pose_convention.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

namespace gigaray {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

CameraPose some_pose() {
  CameraPose pose;
  pose.rotation =
      (AngleAxisd(0.3, Vector3d(1, 2, -1).normalized()) * AngleAxisd(-1.1, Vector3d::UnitY()))
          .toRotationMatrix();
  pose.translation = {0.4, -1.5, 2.5};
  return pose;
}

TEST(PoseConvention, EveryOneIsReadBackFromItsName) {
  std::set<std::string> names;
  for (const PoseConvention& convention : all_pose_conventions()) {
    EXPECT_EQ(parse_pose_convention(name_of(convention)), convention) << name_of(convention);
    names.insert(name_of(convention));
  }
  EXPECT_EQ(names.size(), 96u);
}

TEST(PoseConvention, NamesInUseMeanTheirAxes) {
  EXPECT_EQ(parse_pose_convention("opencv"), (PoseConvention{"RDF", false}));
  EXPECT_EQ(parse_pose_convention("OpenGL-w2c"), (PoseConvention{"RUB", true}));
  EXPECT_EQ(parse_pose_convention("drb-c2w"), (PoseConvention{"DRB", false}));
  for (const char* wrong : {"", "-w2c", "RRF", "RLF", "RDFX", "blender", "RDF w2c", "rd"})
    EXPECT_FALSE(parse_pose_convention(wrong)) << wrong;
}

TEST(PoseConvention, EveryOneStatesAndReadsTheSamePose) {
  const CameraPose pose = some_pose();
  for (const PoseConvention& convention : all_pose_conventions()) {
    const StatedPose stated = state_pose(pose, convention);
    const auto read = read_pose(stated, convention);
    ASSERT_TRUE(read) << name_of(convention);
    // Left-handed axes of the camera in a right-handed scene are a mirrored matrix, no mirrored
    // scene.
    EXPECT_FALSE(read->is_mirrored);
    EXPECT_LT((read->rotation - pose.rotation).norm(), 1e-12) << name_of(convention);
    EXPECT_LT((read->translation - pose.translation).norm(), 1e-12) << name_of(convention);
  }
}

TEST(PoseConvention, OpenGlLooksBackAlongItsThirdAxis) {
  StatedPose stated;
  stated << 1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7;  // stands at (5, 6, 7), looks along -z
  const CameraPose pose = read_pose(stated, {"RUB", false}).value();
  EXPECT_LT((pose.rotation * Vector3d(5, 6, 0) + pose.translation - Vector3d(0, 0, 7)).norm(),
            1e-12);
  EXPECT_LT((pose.rotation * Vector3d(6, 7, 0) + pose.translation - Vector3d(1, -1, 7)).norm(),
            1e-12);
}

TEST(PoseConvention, AxesScaledAlikeAreMadeUnit) {
  const CameraPose pose = some_pose();
  StatedPose to_scene = state_pose(pose, {"RUB", false});
  to_scene.leftCols<3>() *= 2.5;  // an object of Blender that was scaled
  EXPECT_LT((read_pose(to_scene, {"RUB", false})->translation - pose.translation).norm(), 1e-12);
  StatedPose to_camera = state_pose(pose, {"RDF", true});
  to_camera *= 0.04;  // a scene that was scaled: both parts are
  const CameraPose read = read_pose(to_camera, {"RDF", true}).value();
  EXPECT_LT((read.rotation - pose.rotation).norm(), 1e-12);
  EXPECT_LT((read.translation - pose.translation).norm(), 1e-12);
}

TEST(PoseConvention, LeftHandedFramesMirrorTheSceneAndNothingElse) {
  // Unity: x right, y up, z forward, in a scene that is left-handed too.
  const CameraPose pose = some_pose();
  StatedPose stated = state_pose(pose, {"RUF", false});
  stated.row(2) *= -1;
  const CameraPose read = read_pose(stated, {"RUF", false}).value();
  EXPECT_TRUE(read.is_mirrored);
  EXPECT_LT((read.rotation - pose.rotation).norm(), 1e-12);
  EXPECT_LT((state_pose(read, {"RUF", false}) - stated).norm(), 1e-12);
}

TEST(PoseConvention, WhatIsNoRotationIsRefused) {
  StatedPose stated = state_pose(some_pose(), {"RDF", false});
  StatedPose stretched = stated, flat = stated, endless = stated;
  stretched.col(0) *= 1.1;
  flat.col(1).setZero();
  endless(0, 3) = std::numeric_limits<double>::quiet_NaN();
  for (const StatedPose& wrong : {stretched, flat, endless})
    EXPECT_FALSE(read_pose(wrong, {"RDF", false}));
  stated(0, 0) += 3e-4;  // rounding
  EXPECT_TRUE(read_pose(stated, {"RDF", false}));
}

}  // namespace
}  // namespace gigaray
