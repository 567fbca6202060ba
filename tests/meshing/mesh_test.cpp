// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Surfaces of solids of known shape, by all methods.
#include <gtest/gtest.h>

#include "gigaray/core/synthetic_solid.h"
#include "gigaray/meshing/cloud.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "gigaray/meshing/mesh_processing.h"
#include "gigaray/meshing/mesh_report.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace solids;
using namespace testing_support;

constexpr int kSize = 61;

PointCloud cloud_of(const DepthViews& views, double voxel) {
  CloudOptions options;
  options.voxel = voxel;
  PointCloud cloud;
  build_cloud(views, options, [&](const PointCloud& tile) { append(cloud, tile); }, {});
  return cloud;
}

/// Share of the triangles that look to the side that cameras saw.
double share_outwards(const Solid& solid, const SurfaceMesh& mesh) {
  std::size_t outwards = 0;
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d a = mesh.positions[face[0]].cast<double>(),
                          b = mesh.positions[face[1]].cast<double>(),
                          c = mesh.positions[face[2]].cast<double>();
    const Eigen::Vector3d middle = (a + b + c) / 3, way = 0.01 * (b - a).cross(c - a).normalized();
    outwards += solid.distance(middle + way) > solid.distance(middle - way);
  }
  return double(outwards) / double(mesh.faces.size());
}

TEST(GridMesh, LiesOnTheSurfaceAndLooksOutwards) {
  for (const Solid& solid : {sphere(), box(), tilted_planes(), rod()}) {
    SCOPED_TRACE(solid.name);
    const DepthViews views = views_of(solid, cameras_on_an_arc(5, kSize));
    PointCounts counts;
    const SurfaceMesh mesh = grid_mesh(views, {}, &counts, {});
    EXPECT_GT(counts.points, 1000u);
    EXPECT_LT(distances_to(solid, mesh.positions).most, 1e-3);
    EXPECT_EQ(share_outwards(solid, mesh), 1);
  }
}

TEST(GridMesh, NothingHangsBetweenTheRodAndTheWall) {
  const SurfaceMesh mesh = grid_mesh(views_of(rod(), cameras_on_an_arc(5, kSize)), {}, nullptr, {});
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3f middle =
        (mesh.positions[face[0]] + mesh.positions[face[1]] + mesh.positions[face[2]]) / 3;
    EXPECT_LT(rod().distance(middle.cast<double>()), 0.03);
  }
}

TEST(GridMesh, ASecondViewAddsWhatTheFirstDoesNotShow) {
  const std::vector<Camera> cameras = cameras_all_around(16, kSize);
  const SurfaceMesh one = grid_mesh(views_of(sphere(), {cameras[0]}), {}, nullptr, {});
  const SurfaceMesh all = grid_mesh(views_of(sphere(), cameras), {}, nullptr, {});
  const double area = report_of(all).area, sphere_area = 4 * std::numbers::pi;
  EXPECT_LT(report_of(one).area, 0.5 * sphere_area);
  // Not once per view: pieces overlap at their rims alone.
  EXPECT_GT(area, 0.97 * sphere_area);
  EXPECT_LT(area, 1.4 * sphere_area);
}

TEST(PoissonMesh, OfASphereIsWatertightWithoutAHandle) {
  const PointCloud cloud = cloud_of(views_of(sphere(), cameras_all_around(24, kSize)), 0.06);
  const SurfaceMesh mesh = cleaned(poisson_mesh(cloud, {}, {}), {}, nullptr);
  const MeshReport report = report_of(mesh);
  EXPECT_TRUE(report.is_watertight);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus, 0u);
  ASSERT_TRUE(report.volume.has_value());
  EXPECT_NEAR(*report.volume, 4.0 / 3 * std::numbers::pi, 0.2);  // positive: it looks outwards
  EXPECT_LT(distances_to(sphere(), mesh.positions).most, 0.02);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_NEAR(mesh.colours[i][0], 127.5 * (1 + mesh.positions[i].x()), 12);
}

TEST(PoissonMesh, OfAnOpenSceneLooksToTheCameras) {
  for (const Solid& solid : {tilted_planes(), rod()}) {
    SCOPED_TRACE(solid.name);
    const PointCloud cloud = cloud_of(views_of(solid, cameras_on_an_arc(5, kSize)), 0.05);
    const SurfaceMesh mesh = cleaned(poisson_mesh(cloud, {}, {}), {}, nullptr);
    EXPECT_GT(share_outwards(solid, mesh), 0.97);
  }
}

TEST(PoissonMesh, FindsEveryPieceAndIsTheSameAgain) {
  const Solid balls{"nine balls", [](const Eigen::Vector3d& x) {
                      const Eigen::Vector3d nearest(std::clamp(std::round(x.x()), -1.0, 1.0),
                                                    std::clamp(std::round(x.y()), -1.0, 1.0), 0);
                      return (x - nearest).norm() - 0.25;
                    }};
  const PointCloud cloud = cloud_of(views_of(balls, cameras_all_around(24, kSize)), 0.06);
  const SurfaceMesh mesh = cleaned(poisson_mesh(cloud, {}, {}), {}, nullptr);
  EXPECT_EQ(report_of(mesh).components, 9u);
  const SurfaceMesh again = cleaned(poisson_mesh(cloud, {}, {}), {}, nullptr);
  EXPECT_TRUE(again.positions == mesh.positions);
  EXPECT_TRUE(again.faces == mesh.faces);
}

TEST(CloudMeshes, StopWhenCancelled) {
  const PointCloud cloud = cloud_of(views_of(sphere(), cameras_on_an_arc(5, kSize)), 0.06);
  RunControl control;
  control.cancel();
  expect_error(ErrorCode::kCancelled, {"stopped"}, [&] { poisson_mesh(cloud, {}, control); });
  expect_error(ErrorCode::kCancelled, {"stopped"},
               [&] { advancing_front_mesh(cloud, {}, control); });
}

TEST(PoissonMesh, IsTrimmedWhereThereAreNoPoints) {
  const PointCloud half = cloud_of(views_of(sphere(), cameras_on_an_arc(5, kSize)), 0.06);
  const SurfaceMesh trimmed = cleaned(poisson_mesh(half, {}, {}), {}, nullptr);
  const SurfaceMesh closed =
      cleaned(poisson_mesh(half, {.spacing = 1, .trim = 0}, {}), {}, nullptr);
  EXPECT_GT(report_of(trimmed).boundary_edges, 0u);
  EXPECT_LT(report_of(trimmed).area, report_of(closed).area);
  EXPECT_LT(distances_to(sphere(), trimmed.positions).most, 0.1);
}

TEST(AdvancingFrontMesh, GoesThroughThePointsAndLooksOutwards) {
  for (const Solid& solid : {sphere(), box()}) {
    SCOPED_TRACE(solid.name);
    const PointCloud cloud = cloud_of(views_of(solid, cameras_all_around(24, kSize)), 0.06);
    const SurfaceMesh mesh = cleaned(advancing_front_mesh(cloud, {}, {}), {}, nullptr);
    EXPECT_LT(distances_to(solid, mesh.positions).most, 0.03);
    EXPECT_GT(share_outwards(solid, mesh), 0.97);
    EXPECT_EQ(report_of(mesh).genus, 0u);
  }
}

TEST(CloudMeshes, WhatGivesNoSurfaceIsNamed) {
  PointCloud cloud = cloud_of(views_of(sphere(), cameras_on_an_arc(3, kSize)), 0.1);
  expect_error(ErrorCode::kInvalidArgument, {"spacing"},
               [&] { poisson_mesh(cloud, {.spacing = 0, .trim = 1}, {}); });
  expect_error(ErrorCode::kInvalidArgument, {"edge"},
               [&] { advancing_front_mesh(cloud, {.longest_edge = std::nanf("")}, {}); });
  PointCloud few;
  append(few, cloud);
  few.positions.resize(3);
  expect_error(ErrorCode::kBadInput, {"10 points"}, [&] { poisson_mesh(few, {}, {}); });
  PointCloud heap = cloud;
  std::ranges::fill(heap.positions, Eigen::Vector3f(1, 2, 3));
  expect_error(ErrorCode::kBadInput, {"same place"}, [&] { advancing_front_mesh(heap, {}, {}); });
  cloud.positions[5].x() = std::nanf("");
  expect_error(ErrorCode::kBadInput, {"not finite"}, [&] { poisson_mesh(cloud, {}, {}); });
}

/// A closed box with 12 triangles, and what can be wrong with it.
SurfaceMesh cube() {
  SurfaceMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(float(i & 1), float(i >> 1 & 1), float(i >> 2));
    mesh.normals.emplace_back(0, 0, 1);
    mesh.colours.push_back({std::uint8_t(i), 0, 0});
  }
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A ring with a square section: one handle.
SurfaceMesh ring() {
  SurfaceMesh mesh;
  constexpr int kAround = 24, kSection = 4;
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kSection; ++k) {
      const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * k / kSection;
      const double r = 2 + 0.5 * std::cos(b);
      mesh.positions.emplace_back(float(r * std::cos(a)), float(r * std::sin(a)),
                                  float(0.5 * std::sin(b)));
      mesh.normals.emplace_back(0, 0, 1);
      mesh.colours.push_back({});
    }
  const auto at = [](int i, int k) { return std::uint32_t(i % kAround * kSection + k % kSection); };
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kSection; ++k) {
      mesh.faces.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      mesh.faces.push_back({at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

TEST(MeshReport, KnowsACube) {
  const MeshReport report = report_of(cube());
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_EQ(report.faces, 12u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus, 0u);
  EXPECT_TRUE(report.is_watertight);
  EXPECT_NEAR(report.area, 6, 1e-6);
  EXPECT_NEAR(std::abs(report.volume.value()), 1, 1e-6);
  EXPECT_EQ(report.most, Eigen::Vector3f(1, 1, 1));
}

TEST(MeshReport, CountsHandlesHolesAndPieces) {
  EXPECT_EQ(report_of(ring()).genus, 1u);
  SurfaceMesh open = cube();
  open.faces.erase(open.faces.begin(), open.faces.begin() + 2);
  const MeshReport report = report_of(open);
  EXPECT_EQ(report.boundary_edges, 4u);
  EXPECT_EQ(report.boundary_loops, 1u);
  EXPECT_EQ(report.genus, 0u);
  EXPECT_FALSE(report.is_watertight);
  EXPECT_FALSE(report.volume.has_value());

  // A second cube that cuts the first.
  SurfaceMesh two = cube();
  const SurfaceMesh other = cube();
  for (const Eigen::Vector3f& p : other.positions)
    two.positions.push_back(p + Eigen::Vector3f(0.5f, 0.4f, 0.3f));
  two.normals.resize(16, Eigen::Vector3f(0, 0, 1));
  two.colours.resize(16);
  for (auto face : other.faces) {
    for (std::uint32_t& corner : face) corner += 8;
    two.faces.push_back(face);
  }
  const MeshReport cut = report_of(two);
  EXPECT_EQ(cut.components, 2u);
  EXPECT_GT(cut.self_intersections, 0u);
  EXPECT_FALSE(cut.is_watertight);
  EXPECT_EQ(report_of({}).faces, 0u);
}

TEST(MeshProcessing, FillsHolesDropsPiecesAndCollapsesEdges) {
  SurfaceMesh open = cube();
  open.faces.erase(open.faces.begin(), open.faces.begin() + 2);
  MeshCleaned done;
  const SurfaceMesh filled =
      cleaned(open, {.least_faces = 1, .hole_edges = 4, .most_faces = 0}, &done);
  EXPECT_EQ(done.holes_filled, 1u);
  EXPECT_TRUE(report_of(filled).is_watertight);
  const SurfaceMesh small_hole_alone =
      cleaned(open, {.least_faces = 1, .hole_edges = 3, .most_faces = 0}, &done);
  EXPECT_EQ(done.holes_filled, 0u);
  EXPECT_EQ(small_hole_alone.faces.size(), 10u);

  EXPECT_TRUE(
      cleaned(cube(), {.least_faces = 13, .hole_edges = 0, .most_faces = 0}, &done).faces.empty());
  EXPECT_EQ(done.pieces_dropped, 1u);

  const SurfaceMesh fine =
      grid_mesh(views_of(tilted_planes(), cameras_on_an_arc(3, kSize)), {}, nullptr, {});
  const SurfaceMesh coarse =
      cleaned(fine, {.least_faces = 1, .hole_edges = 0, .most_faces = 500}, nullptr);
  EXPECT_LE(coarse.faces.size(), 550u);
  EXPECT_LT(distances_to(tilted_planes(), coarse.positions).mean, 0.01);
}

TEST(MeshProcessing, KeepsSmallPatchesOnALargePieceAlone) {
  SurfaceMesh mesh =
      grid_mesh(views_of(tilted_planes(), cameras_on_an_arc(3, kSize)), {}, nullptr, {});
  mesh = cleaned(mesh, {}, nullptr);
  const std::size_t faces = mesh.faces.size(), pieces = report_of(mesh).components;
  // A triangle a little before the middle of another one, and the same far away.
  const auto hover = [&](float distance) {
    const auto face = mesh.faces[faces / 2];
    for (const std::uint32_t corner : face) {
      mesh.positions.push_back(mesh.positions[corner] - distance * Eigen::Vector3f::UnitZ());
      mesh.normals.push_back(mesh.normals[corner]);
      mesh.colours.push_back(mesh.colours[corner]);
    }
    const auto last = std::uint32_t(mesh.positions.size());
    mesh.faces.push_back({last - 3, last - 2, last - 1});
  };
  hover(0.002f);
  hover(0.5f);
  MeshCleaned done;
  const SurfaceMesh kept = cleaned(mesh, {}, &done);
  EXPECT_EQ(done.pieces_dropped, 1u);
  EXPECT_EQ(kept.faces.size(), faces + 1);
  EXPECT_EQ(report_of(kept).components, pieces + 1);
}

TEST(MeshProcessing, ABranchingSurfaceBecomesAManifold) {
  // Three sheets at one edge, and two that touch in a corner.
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 2, 1}, {1, 2, 1}};
  mesh.normals.resize(7, Eigen::Vector3f(0, 0, 1));
  mesh.colours.resize(7);
  mesh.colours[0] = {9, 9, 9};
  mesh.faces = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 5, 6}};
  const SurfaceMesh result =
      cleaned(mesh, {.least_faces = 1, .hole_edges = 0, .most_faces = 0}, nullptr);
  EXPECT_EQ(result.faces.size(), 4u);
  EXPECT_GT(result.positions.size(), mesh.positions.size());
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    const bool is_copy_of_first = result.positions[i].norm() == 0;
    EXPECT_EQ(result.colours[i] == (Rgb8{9, 9, 9}), is_copy_of_first);
  }
}

}  // namespace
}  // namespace gigaray
