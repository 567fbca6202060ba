// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/novel_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gigaray/applications/picture_quality.h"
#include "gigaray/applications/refocus.h"
#include "gigaray/applications/rig_cameras.h"
#include "support/analytic_field.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::analytic_field;
using testing_support::AnalyticField;
using testing_support::expect_error;
using testing_support::grid_of_views;
using testing_support::row_of_views;

constexpr int kWidth = 93, kHeight = 47;

AnalyticField two_layers(std::vector<View> views) {
  return analytic_field(kWidth, kHeight, std::move(views),
                        {{-0.5, 1}, {1.5, 2, 1, 30, 60, 12, 33}});
}

std::vector<DepthView> sources_of(const AnalyticField& field, const RigCameras& rig,
                                  int without = -1) {
  std::vector<DepthView> sources;
  for (int view = 0; view < field.light_field.num_views(); ++view)
    if (view != without)
      sources.push_back({rig.camera(view), read_view(field.light_field, view),
                         rig.inverse_depth(field.disparity[view])});
  return sources;
}

PictureQuality quality_without(const AnalyticField& field, int view,
                               const NovelViewOptions& options = {}) {
  const RigCameras rig(field.light_field, -0.5);
  const NovelView novel =
      render_view(rig.camera(view), sources_of(field, rig, view), 8, options, {});
  return picture_quality(novel.picture, read_view(field.light_field, view), 8);
}

TEST(RigCameras, ProjectAsDisparityShifts) {
  for (const bool metric : {false, true}) {
    AnalyticField field = two_layers(grid_of_views(3, 3));
    if (metric) field.light_field.rig = {800.0, 0.03, 12.0, "m"};
    const RigCameras rig(field.light_field, -0.5);
    EXPECT_EQ(rig.is_metric(), metric);
    for (const double d : {-0.5, 0.25, 1.5}) {
      const float w = rig.inverse_depth(FloatMap(1, 1, 1, float(d)))(0, 0);
      EXPECT_NEAR(rig.disparity(w), d, 1e-5);
      const View& from = field.light_field.views[1];
      const Eigen::Vector3d point = rig.camera(1).back_project(20, 30, 1 / w);
      for (int other = 0; other < 9; ++other) {
        const View& to = field.light_field.views[other];
        const Eigen::Vector3d seen = rig.camera(other).project(point);
        EXPECT_NEAR(seen.x(), 20 + (from.s - to.s) * d, 1e-4);
        EXPECT_NEAR(seen.y(), 30 + (from.t - to.t) * d, 1e-4);
      }
    }
  }
}

TEST(RigCameras, OpticalAxesAreApartByTheDisparityOfInfinity) {
  // A pair whose principal points are at 9 and 12 px: f B / (d + 3).
  LightField pair;
  pair.width = 23;
  pair.height = 17;
  pair.views = {{"left", -0.5, 0}, {"right", 0.5, 0}};
  pair.rig = {150.5, 176.252, 150.5 * 176.252 / 3, "mm", Eigen::Vector2d(10.5, 8.25)};
  const RigCameras rig(pair, 0);
  EXPECT_NEAR(rig.camera(0).centre_u, 9, 1e-12);
  EXPECT_NEAR(rig.camera(1).centre_u, 12, 1e-12);
  EXPECT_NEAR(rig.camera(1).centre_v, 8.25, 1e-12);
  const Eigen::Vector3d point = rig.camera(0).back_project(14, 5, 150.5 * 176.252 / (7 + 3));
  EXPECT_NEAR(rig.camera(1).project(point).x(), 14 - 7, 1e-9);
  EXPECT_NEAR(rig.camera(1).project(point).y(), 5, 1e-9);
}

TEST(RigCameras, DepthIsThatOfTheRig) {
  AnalyticField field = two_layers(row_of_views(3));
  field.light_field.rig = {1000.0, 0.025, 5.0, "m"};
  const RigCameras rig(field.light_field);
  // d = 0 is at the focus, d = 5 at 2.5 m.
  EXPECT_NEAR(rig.inverse_depth(FloatMap(1, 1, 1, 0))(0, 0), 1 / 5.0, 1e-6);
  EXPECT_NEAR(rig.inverse_depth(FloatMap(1, 1, 1, 5))(0, 0), 1 / 2.5, 1e-6);
  EXPECT_TRUE(std::isnan(rig.inverse_depth(FloatMap(1, 1, 1, -5.1f))(0, 0)));
}

TEST(NovelView, AViewThatWasLeftOutComesBack) {
  const AnalyticField field = two_layers(grid_of_views(3, 3));
  const PictureQuality quality = quality_without(field, 4);
  EXPECT_GT(quality.psnr, 36);
  EXPECT_GT(quality.ssim, 0.98);
}

TEST(NovelView, AtASourceItIsTheSource) {
  const AnalyticField field = two_layers(row_of_views(5));
  const RigCameras rig(field.light_field, -0.5);
  const NovelView novel = render_view(rig.camera(2), sources_of(field, rig), 8, {}, {});
  EXPECT_GT(picture_quality(novel.picture, read_view(field.light_field, 2), 8).psnr, 45);
  EXPECT_EQ(std::count(novel.seen.begin(), novel.seen.end(), 0), 0);
}

TEST(NovelView, KnowsItsDepth) {
  const AnalyticField field = two_layers(row_of_views(5));
  const RigCameras rig(field.light_field, -0.5);
  const NovelView novel = render_view(rig.camera(2), sources_of(field, rig, 2), 8, {}, {});
  int wrong = 0;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      wrong +=
          !(std::abs(rig.disparity(novel.inverse_depth(u, v)) - field.disparity[2](u, v)) < 0.05);
  // Points reach 3/4 px.
  EXPECT_LT(wrong, 2 * 2 * (33 - 12 + 2) + 2 * 2 * 30);
}

TEST(NovelView, APointThatOthersSeeThroughIsNotShown) {
  const AnalyticField field = two_layers(row_of_views(7));
  const RigCameras rig(field.light_field, -0.5);
  std::vector<DepthView> sources = sources_of(field, rig, 3);
  const NovelView clean = render_view(rig.camera(3), sources, 8, {}, {});
  // A patch of one source floats in front of everything.
  for (int v = 38; v < 43; ++v)
    for (int u = 70; u < 75; ++u)
      sources[0].inverse_depth(u, v) = rig.inverse_depth(FloatMap(1, 1, 1, 2.5f))(0, 0);
  const NovelView novel = render_view(rig.camera(3), sources, 8, {}, {});
  EXPECT_GT(picture_quality(novel.picture, clean.picture, 8).psnr, 45);
}

TEST(NovelView, ViewDependentWeightsFollowShine) {
  // The whole scene gets brighter from left to right.
  AnalyticField field = two_layers(row_of_views(7));
  std::vector<Image<std::uint16_t>> pictures;
  for (int view = 0; view < 7; ++view) {
    pictures.push_back(read_view(field.light_field, view));
    for (std::uint16_t& value : pictures.back())
      value = std::uint16_t(std::min(255, value * (20 + view) / 26));
  }
  field.light_field.pixels = pixels_in_memory(std::move(pictures), 8);
  NovelViewOptions equal;
  equal.blend.view_dependent = false;
  EXPECT_GT(quality_without(field, 1).psnr, quality_without(field, 1, equal).psnr + 3);
}

TEST(NovelView, GapsShowWhatIsBehindAndAreToldApart) {
  const AnalyticField field = two_layers(row_of_views(5));
  const RigCameras rig(field.light_field, -0.5);
  // One source alone does not see what the patch hides.
  const std::vector<DepthView> all = sources_of(field, rig);
  const NovelView novel = render_view(rig.camera(0), std::span(&all[4], 1), 8, {}, {});
  int gaps = 0;
  for (int v = 15; v < 30; ++v)
    for (int u = 10; u < 80; ++u)
      if (!novel.seen(u, v)) {
        ++gaps;
        EXPECT_NEAR(rig.disparity(novel.inverse_depth(u, v)), -0.5, 0.05);
      }
  EXPECT_GT(gaps, 15);
}

TEST(NovelView, SourcesWithoutDepthGiveNothing) {
  AnalyticField field = two_layers(row_of_views(3));
  for (FloatMap& map : field.disparity) std::fill(map.begin(), map.end(), kNoEstimate);
  const RigCameras rig(field.light_field, -0.5);
  const NovelView novel = render_view(rig.camera(1), sources_of(field, rig), 8, {}, {});
  EXPECT_EQ(std::count(novel.seen.begin(), novel.seen.end(), 1), 0);
  EXPECT_TRUE(std::all_of(novel.picture.begin(), novel.picture.end(),
                          [](std::uint16_t value) { return value == 0; }));
}

TEST(NovelView, NoSourceIsAnError) {
  const AnalyticField field = two_layers(row_of_views(3));
  const RigCameras rig(field.light_field, -0.5);
  expect_error(ErrorCode::kInvalidArgument, {"made of 1"},
               [&] { render_view(rig.camera(1), {}, 8, {}, {}); });
}

TEST(NearestCameras, ComeInOrderWithoutTheExcludedOne) {
  const AnalyticField field = two_layers(row_of_views(7));
  const RigCameras rig(field.light_field, -0.5);
  const std::vector<int> nearest = nearest_cameras(rig.cameras(), rig.camera(3), 3, 3);
  ASSERT_EQ(nearest.size(), 3u);
  EXPECT_EQ(std::abs(nearest[0] - 3), 1);
  EXPECT_EQ(std::abs(nearest[1] - 3), 1);
  EXPECT_EQ(std::abs(nearest[2] - 3), 2);
}

TEST(Between, HalfWayIsInTheMiddle) {
  Camera a, b;
  a.width = b.width = a.height = b.height = 10;
  a.focal_u = a.focal_v = 10;
  b.focal_u = b.focal_v = 20;
  b.rotation = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix();
  b.translation = -b.rotation * Eigen::Vector3d(2, 0, 1);
  const Camera half = between(a, b, 0.5);
  EXPECT_NEAR(half.focal_u, 15, 1e-12);
  EXPECT_NEAR((half.position() - Eigen::Vector3d(1, 0, 0.5)).norm(), 0, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(half.rotation).angle(), 0.2, 1e-12);
}

TEST(Refocus, WhatIsInFocusIsSharpAndTheRestIsNot) {
  const AnalyticField field = two_layers(grid_of_views(5, 5));
  const int centre = centre_view(field.light_field);
  const Image<std::uint16_t> picture = read_view(field.light_field, centre);
  const auto error_at = [&](double disparity, int u0, int u1, int v0, int v1) {
    const Image<std::uint16_t> refocused = refocus(field.light_field, centre, {disparity}, 1e9, {});
    double sum = 0;
    for (int v = v0; v < v1; ++v)
      for (int u = u0; u < u1; ++u)
        for (int c = 0; c < 3; ++c) sum += std::abs(refocused(u, v, c) - picture(u, v, c));
    return sum / (3.0 * (u1 - u0) * (v1 - v0));
  };
  EXPECT_LT(error_at(1.5, 38, 52, 18, 27), 3);
  EXPECT_GT(error_at(-0.5, 38, 52, 18, 27), 12);
  EXPECT_LT(error_at(-0.5, 70, 90, 5, 40), 3);
}

TEST(Refocus, AnApertureOfNothingIsTheView) {
  const AnalyticField field = two_layers(row_of_views(5));
  EXPECT_TRUE(refocus(field.light_field, 1, {0.7}, 0, {}) == read_view(field.light_field, 1));
}

TEST(Refocus, ATiltedPlaneIsSharpAlongItsLine) {
  const AnalyticField field = two_layers(row_of_views(7));
  const int centre = centre_view(field.light_field);
  // −0.5 in the last column, where the far plane is.
  const FocalPlane plane{0.5, -1 / 46.0, 0};
  const Image<std::uint16_t> refocused = refocus(field.light_field, centre, plane, 1e9, {});
  const Image<std::uint16_t> picture = read_view(field.light_field, centre);
  double near_line = 0, far_from_it = 0;
  for (int v = 0; v < kHeight; ++v) {
    near_line += std::abs(refocused(91, v, 1) - picture(91, v, 1));
    far_from_it += std::abs(refocused(70, v, 1) - picture(70, v, 1));
  }
  EXPECT_LT(near_line, 0.5 * far_from_it);
}

TEST(PictureQuality, KnownValues) {
  Image<std::uint16_t> a(64, 48, 3, 100), b(64, 48, 3, 110);
  EXPECT_TRUE(std::isinf(picture_quality(a, a, 8).psnr));
  EXPECT_NEAR(picture_quality(a, a, 8).ssim, 1, 1e-6);
  // 20 log10(255 / 10)
  EXPECT_NEAR(picture_quality(b, a, 8).psnr, 28.1308, 1e-3);
  // Flat pictures: (2 μ μ' + C1) / (μ² + μ'² + C1), C1 = (0.01 · 255)².
  EXPECT_NEAR(picture_quality(b, a, 8).ssim,
              (2 * 100.0 * 110 + 6.5025) / (100.0 * 100 + 110.0 * 110 + 6.5025), 1e-4);
}

}  // namespace
}  // namespace gigaray
