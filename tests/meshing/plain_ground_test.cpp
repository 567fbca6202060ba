// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "src/plain_ground.h"

#include <gtest/gtest.h>

#include "gigaray/core/synthetic_solid.h"
#include "gigaray/meshing/cloud.h"

namespace gigaray {
namespace {

using namespace solids;

constexpr int kSize = 73;

/// A sphere on a ground of one colour whose pixels lie in a plane through the middle of the sphere:
/// next to an object they get its depth, since nothing speaks against that.
DepthViews sphere_on(Rgb8 ground) {
  DepthViews views = views_of(sphere(), cameras_on_an_arc(7, kSize));
  views.read = [read = views.read, ground](int index) {
    DepthView view = read(index);
    for (int v = 0; v < view.camera.height; ++v)
      for (int u = 0; u < view.camera.width; ++u) {
        if (view.inverse_depth(u, v) > 0) continue;
        const Eigen::Vector3d eye = view.camera.position();
        const Eigen::Vector3d step = view.camera.back_project(u, v, 1) - eye;
        view.inverse_depth(u, v) = float(-step.z() / eye.z());
        for (int c = 0; c < 3; ++c) view.picture(u, v, c) = ground[std::size_t(c)];
      }
    return view;
  };
  return views;
}

/// Share of the points that are not on the sphere.
double share_afloat(const DepthViews& views, const CloudOptions& options, CloudReport& report) {
  std::size_t afloat = 0;
  const auto take = [&](const PointCloud& tile) {
    afloat += std::size_t(std::ranges::count_if(
        tile.positions, [](const Eigen::Vector3f& p) { return std::abs(p.norm() - 1) > 0.05f; }));
  };
  report = build_cloud(views, options, take, {});
  return double(afloat) / double(report.points);
}

TEST(PlainGround, HasNoPoints) {
  for (const Rgb8 colour : {Rgb8{255, 255, 255}, Rgb8{2, 0, 4}}) {
    CloudReport without, with;
    EXPECT_EQ(plain_ground(sphere_on(colour), {}), colour);
    EXPECT_EQ(share_afloat(sphere_on(colour), {}, without), 0);
    EXPECT_GT(without.pixels.ground, without.pixels.points / 2);
    CloudOptions kept;
    kept.points.keeps_plain_ground = true;
    EXPECT_GT(share_afloat(sphere_on(colour), kept, with), 0.2);
    EXPECT_EQ(with.pixels.ground, 0u);
  }
}

TEST(PlainGround, IsWhiteOrBlackInAllViews) {
  EXPECT_FALSE(plain_ground(sphere_on({120, 120, 120}), {}));
  DepthViews views = sphere_on({255, 255, 255});
  views.read = [read = views.read](int index) {
    DepthView view = read(index);
    if (index == 4) std::ranges::fill(view.picture, std::uint16_t(90));
    return view;
  };
  EXPECT_FALSE(plain_ground(views, {}));
  EXPECT_FALSE(plain_ground(views_of(rod(), cameras_on_an_arc(3, kSize)), {}));
  // Black because it is masked.
  EXPECT_FALSE(plain_ground(views_of(sphere(), cameras_on_an_arc(3, kSize)), {}));
}

TEST(PlainGround, OfHolesIsUnknownAndMasksStayMasks) {
  DepthViews views = sphere_on({255, 255, 255});
  views.read = [read = views.read](int index) {
    DepthView view = read(index);
    for (int c = 0; c < 3; ++c) view.picture(36, 31, c) = 250;  // in the sphere
    view.inverse_depth(2, 3) = kNoEstimate;
    return view;
  };
  const float sphere = views.read(3).inverse_depth(38, 31);
  const DepthView clear = without_ground(views, {255, 255, 255}).read(3);
  EXPECT_TRUE(std::isnan(clear.inverse_depth(36, 31)));
  EXPECT_TRUE(std::isnan(clear.inverse_depth(2, 3)));
  EXPECT_EQ(clear.inverse_depth(3, 3), 0);
  EXPECT_EQ(clear.inverse_depth(38, 31), sphere);
}

}  // namespace
}  // namespace gigaray
