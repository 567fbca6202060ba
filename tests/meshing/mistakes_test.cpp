// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <cmath>

#include "gigaray/meshing/cloud.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "gigaray/meshing/mesh_processing.h"
#include "gigaray/meshing/mesh_report.h"
#include "gigaray/meshing/texture.h"
#include "gigaray/meshing/view_points.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

/// A view with a map that is as large as its camera says, or not.
DepthView view_of(int width, int height) {
  DepthView view;
  view.camera.width = 8;
  view.camera.height = 6;
  view.camera.focal_u = view.camera.focal_v = 8;
  view.inverse_depth = FloatMap(width, height, 1, 1.0f);
  return view;
}

TEST(MistakesOfMeshing, ViewsThatAreNone) {
  const RunControl control;
  const auto take = [](const PointCloud&) {};
  const DepthViews none;
  expect_mistake("survey", [&] { survey(none, control); });
  expect_mistake("cloud", [&] { build_cloud(none, {}, take, control); });
  expect_mistake("grid", [&] { grid_mesh(none, {}, nullptr, control); });
  const DepthView good = view_of(8, 6), bad = view_of(3, 3);
  const DepthViews one{{good.camera}, [&](int) { return good; }};
  expect_mistake("take", [&] { build_cloud(one, {}, {}, control); });
  CloudOptions options;
  options.voxel = NAN;
  expect_mistake("voxel", [&] { build_cloud(one, options, take, control); });
  options = {};
  options.neighbours = -1;
  expect_mistake("neighbours", [&] { build_cloud(one, options, take, control); });
  expect_mistake("map", [&] { keep_pixels(bad, {}, {}, {}); });
  expect_mistake("witness", [&] { keep_pixels(good, std::span(&bad, 1), {}, {}); });
  PointOptions unsure;
  unsure.least_confidence = NAN;
  expect_mistake("confidence", [&] { keep_pixels(good, {}, {}, unsure); });
  expect_mistake("kept", [&] { points_of(good, KeptPixels(), {}); });
  for (const int view : {-1, 1}) expect_mistake("view", [&] { witnesses_of({Camera()}, view, 3); });
  expect_mistake("most", [] { witnesses_of({Camera()}, 0, -1); });
  EXPECT_TRUE(farthest_first({}).empty());
}

TEST(MistakesOfMeshing, ASurfaceOrACloudThatIsNone) {
  const RunControl control;
  SurfaceMesh mesh;
  const DepthView good = view_of(8, 6);
  const DepthViews one{{good.camera}, [&](int) { return good; }};
  expect_mistake("no faces", [&] { texture_of(mesh, one, {}, nullptr, control); });
  mesh.positions.emplace_back(0, 0, 0);
  mesh.colours.push_back({});
  mesh.faces.push_back({0, 1, 2});
  expect_mistake("corners", [&] { texture_of(mesh, one, {}, nullptr, control); });
  expect_mistake("corners", [&] { cleaned(mesh, {}, nullptr); });
  expect_mistake("corners", [&] { report_of(mesh); });
  expect_mistake("size", [&] { texture_of(mesh, one, {7, true}, nullptr, control); });
  PointCloud cloud;
  expect_mistake("empty", [&] { poisson_mesh(cloud, {}, control); });
  expect_mistake("empty", [&] { advancing_front_mesh(cloud, {}, control); });
  for (int i = 0; i < 12; ++i) cloud.positions.emplace_back(i % 3, i / 3, 0);
  expect_mistake("normals", [&] { poisson_mesh(cloud, {}, control); });
  expect_mistake("colours", [&] { advancing_front_mesh(cloud, {}, control); });
  expect_mistake("spacing", [&] { poisson_mesh(cloud, {NAN, 2}, control); });
  expect_mistake("edge", [&] { advancing_front_mesh(cloud, {NAN}, control); });
}

}  // namespace
}  // namespace gigaray
