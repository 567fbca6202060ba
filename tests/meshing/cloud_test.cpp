// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/cloud.h"

#include <gtest/gtest.h>

#include <map>

#include "gigaray/core/synthetic_solid.h"
#include "src/thin_cloud.h"
#include "src/tile_store.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace solids;
using namespace testing_support;

constexpr int kSize = 61;

PointCloud cloud_of(const DepthViews& views, const CloudOptions& options,
                    CloudReport* report = nullptr) {
  PointCloud cloud;
  const CloudReport found =
      build_cloud(views, options, [&](const PointCloud& tile) { append(cloud, tile); }, {});
  EXPECT_EQ(found.points, cloud.size());
  if (report) *report = found;
  return cloud;
}

TEST(Cloud, OfASphereIsASphere) {
  const DepthViews views = views_of(sphere(), cameras_all_around(24, kSize));
  CloudReport report;
  const PointCloud cloud = cloud_of(views, {}, &report);
  ASSERT_GT(cloud.size(), 2000u);
  EXPECT_LT(report.merged, report.pixels.points / 2);
  const Distances gaps = distances_to(sphere(), cloud.positions);
  EXPECT_LT(gaps.most, 0.3 * report.voxel);
  int wrong = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    wrong += !(cloud.normals[i].dot(cloud.positions[i].normalized()) > 0.9);
  EXPECT_LT(wrong, 0.01 * double(cloud.size()));
}

TEST(Cloud, OutliersAndNoiseAreTakenOut) {
  const DepthViews views =
      views_of(sphere(), cameras_all_around(24, kSize), {.noise = 0.001, .outliers = 0.05});
  CloudReport report;
  const PointCloud cloud = cloud_of(views, {}, &report);
  EXPECT_GT(report.pixels.contradicted + report.pixels.unconfirmed, 0.02 * report.pixels.points);
  EXPECT_LT(distances_to(sphere(), cloud.positions).most, 0.02);
}

TEST(Cloud, TilesAndDiskChangeNothing) {
  const DepthViews views = views_of(box(), cameras_all_around(12, kSize));
  CloudOptions options;
  options.voxel = 0.0035;  // several tiles
  options.outlier_deviations = 0;
  CloudReport report, spilled;
  const PointCloud in_memory = cloud_of(views, options, &report);
  options.memory = 100'000;
  const PointCloud on_disk = cloud_of(views, options, &spilled);
  EXPECT_GT(report.tiles, 1);
  EXPECT_EQ(report.bytes_on_disk, 0u);
  EXPECT_GT(spilled.bytes_on_disk, 100'000u);
  ASSERT_EQ(in_memory.size(), on_disk.size());
  EXPECT_TRUE(in_memory.positions == on_disk.positions);
  EXPECT_TRUE(in_memory.colours == on_disk.colours);

  // The same points as in one tile.
  PointCloud all;
  const auto tolerance = SurfaceTolerance::of(survey(views, {}).range);
  for (int view = 0; view < views.size(); ++view) {
    std::vector<DepthView> witnesses;
    for (const int other : witnesses_of(views.cameras, view, options.points.most_witnesses))
      witnesses.push_back(views.read(other));
    const DepthView own = views.read(view);
    append(all, points_of(own, keep_pixels(own, witnesses, tolerance, options.points), tolerance));
  }
  const double apart =
      std::abs(double(merge_points(all, options.voxel).size()) - double(in_memory.size()));
  EXPECT_LT(apart, 0.002 * double(in_memory.size()));
}

TEST(Cloud, CubesGrowUntilFewEnoughPointsAreLeft) {
  const DepthViews views = views_of(sphere(), cameras_all_around(12, kSize));
  CloudReport usual, thin;
  cloud_of(views, {}, &usual);
  CloudOptions options;
  options.most_points = 500;
  const PointCloud cloud = cloud_of(views, options, &thin);
  EXPECT_LE(cloud.size(), 500u);
  EXPECT_GT(cloud.size(), 250u);
  EXPECT_GT(thin.voxel, usual.voxel);
  EXPECT_EQ(thin.pixels.points, usual.pixels.points);
  EXPECT_LT(distances_to(sphere(), cloud.positions).most, 0.02);
}

TEST(Cloud, NearAndFarPartsKeepWhatPixelsShow) {
  // A ball before a wall eight times as far.
  const Solid solid{"ball and wall",
                    [](const Eigen::Vector3d& x) { return std::min(x.norm() - 0.5, 20 - x.z()); }};
  const DepthViews views = views_of(solid, cameras_on_an_arc(5, kSize));
  const PointCloud cloud = cloud_of(views, {});
  const auto is_near = [](const Eigen::Vector3f& p) { return p.z() < 10; };
  const auto near = double(std::ranges::count_if(cloud.positions, is_near));
  const FloatMap centre = views.read(2).inverse_depth;
  const auto near_pixels =
      double(std::ranges::count_if(centre, [](float w) { return w > 1 / 10.0f; }));
  EXPECT_GT(near, 0.7 * near_pixels);
  EXPECT_LT(near, 2.5 * near_pixels);
  const double far = double(cloud.size()) - near, far_pixels = double(centre.size()) - near_pixels;
  EXPECT_GT(far, 0.5 * far_pixels);
  EXPECT_LT(far, 2.5 * far_pixels);
}

TEST(Cloud, NothingLeftAndAbsurdOptionsAreNamed) {
  DepthViews views = views_of(sphere(), cameras_on_an_arc(5, kSize));
  CloudOptions options;
  options.points.least_confidence = 1;
  const auto read = views.read;
  views.read = [read](int view) {
    DepthView result = read(view);
    std::ranges::fill(result.confidence, 0.5f);
    return result;
  };
  const auto take = [](const PointCloud&) {};
  expect_error(ErrorCode::kBadInput, {"no point is left"},
               [&] { build_cloud(views, options, take, {}); });
  for (const double voxel : {-1.0, std::nan(""), 1e-14}) {
    CloudOptions absurd;
    absurd.voxel = voxel;
    expect_error(ErrorCode::kInvalidArgument, {"voxel"},
                 [&] { build_cloud(views, absurd, take, {}); });
  }
  CloudOptions few;
  few.neighbours = 2;
  expect_error(ErrorCode::kInvalidArgument, {"neighbours"},
               [&] { build_cloud(views, few, take, {}); });
}

TEST(Cloud, OnePixelOfDepthIsNoTrouble) {
  DepthViews views = views_of(sphere(), cameras_on_an_arc(1, kSize));
  const auto read = views.read;
  views.read = [read](int view) {
    DepthView result = read(view);
    const float kept = result.inverse_depth(36, 31);
    std::ranges::fill(result.inverse_depth, kNoEstimate);
    result.inverse_depth(36, 31) = kept;
    return result;
  };
  EXPECT_EQ(cloud_of(views, {}).size(), 1u);
}

PointCloud points(std::vector<Eigen::Vector3f> positions) {
  PointCloud cloud;
  const std::size_t count = positions.size();
  cloud.positions = std::move(positions);
  cloud.normals.assign(count, Eigen::Vector3f(0, 0, -1));
  cloud.colours.assign(count, {10, 20, 30});
  cloud.confidences.assign(count, 0.5f);
  cloud.supports.assign(count, 3);
  return cloud;
}

TEST(ThinCloud, AMillionIdenticalPointsAreOne) {
  PointCloud cloud =
      points(std::vector<Eigen::Vector3f>(1'000'000, Eigen::Vector3f(0.25f, 0.25f, 0.25f)));
  PointCloud merged = merge_points(cloud, 0.1);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_TRUE(merged.positions[0].isApprox(Eigen::Vector3f(0.25f, 0.25f, 0.25f), 1e-3f));
  EXPECT_EQ(merged.colours[0], (Rgb8{10, 20, 30}));
  EXPECT_NEAR(merged.supports[0], 3, 1e-3);
  smooth_normals(merged, 16);
  EXPECT_EQ(points_in_company(merged, 16, 3), std::vector<std::uint8_t>{1});
}

TEST(ThinCloud, MeansOfAttributesAndTheLonePoint) {
  PointCloud cloud = points({{0.01f, 0.01f, 0.01f}, {0.03f, 0.01f, 0.01f}, {0.55f, 0, 0}});
  cloud.colours[1] = {30, 40, 50};
  const PointCloud merged = merge_points(cloud, 0.1);
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_NEAR(merged.positions[0].x(), 0.02, 1e-6);
  EXPECT_EQ(merged.colours[0], (Rgb8{20, 30, 40}));

  std::vector<Eigen::Vector3f> grid;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y) grid.emplace_back(float(x), float(y), 0.0f);
  grid.emplace_back(10.0f, 10.0f, 40.0f);
  const std::vector<std::uint8_t> kept = points_in_company(points(grid), 8, 3);
  EXPECT_EQ(std::ranges::count(kept, 0), 1);
  EXPECT_EQ(kept.back(), 0);
}

TEST(TileStore, EveryPointIsOwnOnceAndKnownToItsNeighbours) {
  TileStore store(1.0, 0.2, 1000);  // most of it goes to disk
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-2, 2);
  std::vector<Eigen::Vector3f> places;
  std::vector<int> levels;
  for (int i = 0; i < 500; ++i) {
    places.emplace_back(uniform(random), uniform(random), uniform(random));
    levels.push_back(i % 3 - 1);
  }
  store.add(points(places), levels);
  std::size_t own = 0, all = 0;
  for (const TileIndex& tile : store.tiles()) {
    const float side = std::ldexp(1.0f, tile.level);
    const PointCloud cloud = store.take(tile);
    all += cloud.size();
    for (const Eigen::Vector3f& position : cloud.positions) {
      own += store.is_own(tile, position);
      EXPECT_GE(position.minCoeff(), -0.2001f * side);
      EXPECT_LE(position.maxCoeff(), 1.2001f * side);
    }
  }
  EXPECT_EQ(own, places.size());
  EXPECT_GT(all, own);
  EXPECT_GT(store.bytes_on_disk(), 0u);
}

}  // namespace
}  // namespace gigaray
