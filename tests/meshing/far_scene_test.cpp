// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Scenes in world coordinates: as fine as at the origin.
#include <gtest/gtest.h>

#include "gigaray/core/synthetic_solid.h"
#include "gigaray/meshing/cloud.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "gigaray/meshing/mesh_processing.h"

namespace gigaray {
namespace {

using namespace solids;
using Eigen::Vector3d;

constexpr int kSize = 61;

/// UTM, ECEF, a national grid with heights, metres.
const std::vector<Vector3d> kPlaces{
    {500123.25, 4649776.5, 210}, {4201853.125, -172044.75, 4780011.5}, {3512345.5, 5400321, -12}};

DepthViews moved(const DepthViews& views, const Vector3d& by) {
  const auto move = [by](Camera camera) {
    camera.translation -= camera.rotation * by;
    return camera;
  };
  DepthViews result;
  for (const Camera& camera : views.cameras) result.cameras.push_back(move(camera));
  result.read = [read = views.read, move](int view) {
    DepthView found = read(view);
    found.camera = move(found.camera);
    return found;
  };
  return result;
}

/// Positions in the frame that the scene had before it was moved, rounded once.
std::vector<Eigen::Vector3f> back(const std::vector<Eigen::Vector3f>& positions,
                                  const Vector3d& origin, const Vector3d& by) {
  std::vector<Eigen::Vector3f> result;
  for (const Eigen::Vector3f& position : positions)
    result.push_back((position.cast<double>() + origin - by).cast<float>());
  return result;
}

TEST(FarScene, IsLookedAtFromARoundPlaceNearTheCameras) {
  const DepthViews views = views_of(sphere(), cameras_on_an_arc(5, kSize));
  const double spacing = 0.03;
  EXPECT_EQ(nearby(views, spacing).origin, Vector3d::Zero());
  EXPECT_EQ(nearby(moved(views, {300, -500, 20}), spacing).origin, Vector3d::Zero());
  for (const Vector3d& place : kPlaces) {
    const NearbyViews near = nearby(moved(views, place), spacing);
    EXPECT_LT((near.origin - place).cwiseAbs().maxCoeff(), 60);
    for (const double value : near.origin) EXPECT_EQ(value, 100 * std::round(value / 100));
    for (int view = 0; view < views.size(); ++view) {
      const Vector3d there = near.views.cameras[view].position() + near.origin - place;
      EXPECT_LT((there - views.cameras[view].position()).norm(), 1e-8);
      EXPECT_EQ(near.views.read(view).camera.translation, near.views.cameras[view].translation);
    }
  }
}

TEST(FarScene, ItsCloudIsAsFineAsThatOfANearOne) {
  const DepthViews views = views_of(box(), cameras_all_around(12, kSize));
  const auto cloud_of = [](const DepthViews& of, CloudReport* report) {
    PointCloud cloud;
    *report = build_cloud(of, {}, [&](const PointCloud& tile) { append(cloud, tile); }, {});
    return cloud;
  };
  CloudReport near_report, report;
  const PointCloud near = cloud_of(views, &near_report);
  EXPECT_EQ(near.origin, Vector3d::Zero());
  for (const Vector3d& place : kPlaces) {
    const PointCloud far = cloud_of(moved(views, place), &report);
    EXPECT_NE(far.origin, Vector3d::Zero());
    EXPECT_EQ(report.origin, far.origin);
    EXPECT_EQ(report.pixels.points, near_report.pixels.points);
    // Voxels begin elsewhere.
    EXPECT_NEAR(double(far.size()), double(near.size()), 0.05 * double(near.size()));
    const auto positions = back(far.positions, far.origin, place);
    EXPECT_LT(distances_to(box(), positions).most,
              1.1 * distances_to(box(), near.positions).most + 1e-5);
  }
}

TEST(FarScene, SurfacesOfEveryMethodLieOnIt) {
  const DepthViews views = views_of(sphere(), cameras_all_around(16, kSize));
  for (const Vector3d& place : kPlaces) {
    const DepthViews far = moved(views, place);
    const SurfaceMesh grid = cleaned(grid_mesh(far, {}, nullptr, {}), {}, nullptr);
    EXPECT_LT(distances_to(sphere(), back(grid.positions, grid.origin, place)).most, 1e-3);
    PointCloud cloud;
    CloudOptions options;
    options.voxel = 0.06;
    build_cloud(far, options, [&](const PointCloud& tile) { append(cloud, tile); }, {});
    for (const SurfaceMesh& raw :
         {poisson_mesh(cloud, {}, {}), advancing_front_mesh(cloud, {}, {})}) {
      const SurfaceMesh mesh = cleaned(raw, {}, nullptr);
      EXPECT_EQ(mesh.origin, grid.origin);
      EXPECT_LT(distances_to(sphere(), back(mesh.positions, mesh.origin, place)).most, 0.03);
    }
  }
}

}  // namespace
}  // namespace gigaray
