// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/view_points.h"

#include <gtest/gtest.h>

#include <set>

#include "gigaray/core/synthetic_solid.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace solids;
using namespace testing_support;

constexpr int kSize = 73;

class ViewPoints : public testing::Test {
 protected:
  const DepthViews views = views_of(sphere(), cameras_on_an_arc(7, kSize));
  const SurfaceTolerance tolerance = SurfaceTolerance::of(survey(views, {}).range);

  std::vector<DepthView> witnesses_for(int view) const {
    std::vector<DepthView> witnesses;
    for (const int other : witnesses_of(views.cameras, view, 12))
      witnesses.push_back(views.read(other));
    return witnesses;
  }
};

TEST_F(ViewPoints, LieOnTheSurfaceAndLookOutwards) {
  const DepthView view = views.read(3);
  const KeptPixels kept = keep_pixels(view, witnesses_for(3), tolerance, {});
  const PointCloud cloud = points_of(view, kept, tolerance);
  EXPECT_EQ(cloud.size(), kept.counts.points);
  ASSERT_GT(cloud.size(), 1000u);
  EXPECT_LT(distances_to(sphere(), cloud.positions).most, 1e-4);
  std::size_t askew = 0;  // at the rim, where neighbours are on one side alone
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.normals[i].norm(), 1, 1e-5);
    askew += !(cloud.normals[i].dot(cloud.positions[i].normalized()) > 0.95);
    EXPECT_NEAR(cloud.colours[i][0], 127.5 * (1 + cloud.positions[i].x()), 1.5);
    EXPECT_GE(cloud.supports[i], 2);
  }
  EXPECT_LT(askew, 0.05 * double(cloud.size()));
}

TEST_F(ViewPoints, WhatOthersSeeThroughIsContradicted) {
  DepthView view = views.read(3);
  // A speck that floats before the sphere, and one behind its surface.
  const float front = view.inverse_depth(36, 31);
  ASSERT_GT(front, 0);
  view.inverse_depth(36, 31) = 1.3f * front;
  view.inverse_depth(30, 28) *= 0.8f;
  view.inverse_depth(25, 30) = std::numeric_limits<float>::infinity();
  view.confidence(40, 30) = 0.05f;
  const KeptPixels kept = keep_pixels(view, witnesses_for(3), tolerance, {});
  EXPECT_EQ(kept.keep(36, 31), 0);
  EXPECT_EQ(kept.keep(30, 28), 0);
  EXPECT_EQ(kept.keep(25, 30), 0);
  EXPECT_EQ(kept.keep(40, 30), 0);
  EXPECT_EQ(kept.keep(38, 30), 1);
  EXPECT_EQ(kept.counts.contradicted, 1u);
  EXPECT_EQ(kept.counts.unsure, 1u);
  EXPECT_GE(kept.counts.unconfirmed, 1u);
  const PointCounts& c = kept.counts;
  EXPECT_EQ(c.pixels,
            c.without_estimate + c.unsure + c.too_far + c.contradicted + c.unconfirmed + c.points);
}

TEST_F(ViewPoints, ALoneViewNeedsNoWitness) {
  const KeptPixels kept = keep_pixels(views.read(0), {}, tolerance, {});
  EXPECT_GT(kept.counts.points, 1000u);
  EXPECT_EQ(kept.counts.unconfirmed, 0u);
}

TEST_F(ViewPoints, UsuallyFourFifthsOfThoseThatShouldSeeAPointMustSeeIt) {
  const DepthView view = views.read(3);
  std::vector<DepthView> witnesses = witnesses_for(3);
  ASSERT_EQ(witnesses.size(), 6u);
  const auto keeps = [&](std::optional<int> support) {
    PointOptions options;
    options.least_support = support;
    return keep_pixels(view, witnesses, tolerance, options).keep(36, 31) == 1;
  };
  // The middle of the sphere, which all see.
  EXPECT_TRUE(keeps(std::nullopt));
  EXPECT_TRUE(keeps(6));
  // Two of them see something farther on one side of it and something nearer on the other: not
  // through it, and not it.
  const auto disturb = [&](DepthView& witness) {
    const Eigen::Vector3d at = witness.camera.project(
        view.camera.back_project(36, 31, 1 / double(view.inverse_depth(36, 31))));
    const int u = int(at.x()), v = int(at.y());
    for (int y = v; y <= v + 1; ++y) {
      witness.inverse_depth(u, y) *= 0.5f;
      witness.inverse_depth(u + 1, y) *= 2;
    }
  };
  disturb(witnesses[0]);
  EXPECT_TRUE(keeps(std::nullopt));  // 5 of 6
  disturb(witnesses[1]);
  EXPECT_FALSE(keeps(std::nullopt));  // 4 of 6
  EXPECT_TRUE(keeps(4));
  EXPECT_FALSE(keeps(5));
  // One without an estimate there is not asked: 4 of 5.
  for (float& value : witnesses[1].inverse_depth) value = kNoEstimate;
  EXPECT_TRUE(keeps(std::nullopt));
}

TEST_F(ViewPoints, AreWhereTheViewsAgree) {
  const std::vector<Camera> fine = cameras_on_an_arc(7, 4 * kSize);
  const DepthViews noisy = views_of(sphere(), fine, {.noise = 0.001});
  const DepthView view = noisy.read(3), exact = views_of(sphere(), fine).read(3);
  std::vector<DepthView> witnesses;
  for (const int other : witnesses_of(noisy.cameras, 3, 12)) witnesses.push_back(noisy.read(other));
  const KeptPixels kept = keep_pixels(view, witnesses, tolerance, {});
  double before = 0, after = 0;
  for (int v = 0; v < view.camera.height; ++v)
    for (int u = 0; u < view.camera.width; ++u) {
      if (!kept.keep(u, v)) continue;
      before += std::pow(view.inverse_depth(u, v) - exact.inverse_depth(u, v), 2);
      after += std::pow(kept.inverse_depth(u, v) - exact.inverse_depth(u, v), 2);
    }
  // Seven independent values would leave 0.38, with weights a little more.
  EXPECT_LT(std::sqrt(after / before), 0.6);
}

TEST(SurfaceTolerances, AreAHundredthOfTheDepthWhereViewsTellThatApart) {
  const SurfaceTolerance tolerance = SurfaceTolerance::of({0.2f, 1.2f});
  EXPECT_FLOAT_EQ(tolerance.at(0.25f, 0.001f), 0.0025f);
  EXPECT_FLOAT_EQ(tolerance.at(0.25f, 0.004f), 0.004f);  // a pixel there is more
  EXPECT_FLOAT_EQ(tolerance.at(0.25f, 0.5f), 0.01f);     // of the range
  EXPECT_FLOAT_EQ(tolerance.at(1.2f, 0.001f), 0.01f);
}

TEST_F(ViewPoints, FarAwayHalfAMetreIsNotTheSamePlace) {
  // A wall at 4 and something near, so that a hundredth of the range is 3.6 % of the depth there.
  const Solid solid{"ball before a wall", [](const Eigen::Vector3d& x) {
                      const Eigen::Vector3d ball(0.6, 0, -2.4);
                      return std::min((x - ball).norm() - 0.1, 0.8 - x.z());
                    }};
  const DepthViews room = views_of(solid, cameras_on_an_arc(7, 4 * kSize));
  const auto room_tolerance = SurfaceTolerance::of(survey(room, {}).range);
  std::vector<DepthView> witnesses;
  for (const int other : witnesses_of(room.cameras, 3, 12)) witnesses.push_back(room.read(other));
  DepthView view = room.read(3);
  ASSERT_GT(room_tolerance.between_views, 0.025 * view.inverse_depth(140, 100));
  view.inverse_depth(140, 100) *= 1.005f;
  view.inverse_depth(150, 100) *= 1.025f;
  const KeptPixels kept = keep_pixels(view, witnesses, room_tolerance, {});
  EXPECT_EQ(kept.keep(140, 100), 1);
  EXPECT_EQ(kept.keep(150, 100), 0);
}

TEST_F(ViewPoints, AbsurdOptionsAreRefused) {
  PointOptions options;
  options.least_support = -1;
  expect_error(ErrorCode::kInvalidArgument, {"support", "-1"},
               [&] { keep_pixels(views.read(0), {}, tolerance, options); });
}

TEST(Witnesses, AreSpreadAndLookTheSameWay) {
  const std::vector<Camera> around = cameras_all_around(40, kSize);
  for (const int other : witnesses_of(around, 7, 12))
    EXPECT_GT(around[other].direction().dot(around[7].direction()), 0.7);
  const std::vector<Camera> arc = cameras_on_an_arc(30, kSize);
  const std::vector<int> chosen = witnesses_of(arc, 0, 6);
  EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), 6u);
  EXPECT_EQ(std::ranges::count(chosen, 0), 0);
  EXPECT_EQ(std::ranges::count(chosen, 29), 1);  // the farthest one too
}

TEST(SurveyOfViews, NoEstimateAtAllIsNamed) {
  DepthViews empty = views_of({"nothing", [](const Eigen::Vector3d&) { return 100.0; }},
                              cameras_on_an_arc(3, kSize));
  expect_error(ErrorCode::kBadInput, {"no view has an estimate"}, [&] { survey(empty, {}); });
}

TEST(SurveyOfViews, RangeAndSpacingAreThoseOfTheScene) {
  const Survey found = survey(views_of(sphere(), cameras_on_an_arc(5, kSize)), {});
  EXPECT_NEAR(found.range.max, 1 / 2.2, 0.02);
  EXPECT_NEAR(found.range.min, 1 / 3.0, 0.03);
  EXPECT_NEAR(found.spacing, 2.4 / (1.1 * kSize), 0.15 * found.spacing);
}

}  // namespace
}  // namespace gigaray
