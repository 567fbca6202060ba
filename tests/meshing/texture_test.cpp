// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Textures of solids of known shape and paint.
#include "gigaray/meshing/texture.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "gigaray/core/srgb.h"
#include "gigaray/core/synthetic_solid.h"
#include "gigaray/meshing/cloud.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "gigaray/meshing/mesh_processing.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace solids;
using namespace testing_support;

constexpr int kSize = 93;

/// sRGB, 0 … 255, at a place.
using Paint = std::function<Eigen::Array3d(const Eigen::Vector3d&)>;

Eigen::Array3d stripes(const Eigen::Vector3d& x) {
  return 130 +
         70 * Eigen::Array3d(std::sin(9 * x.x()), std::sin(8 * x.y() + 1), std::sin(7 * x.z()));
}

/// The views with other colours; gains: of their linear light, one after the other.
DepthViews painted(const DepthViews& views, const Paint& paint, std::vector<double> gains = {1}) {
  DepthViews result = views;
  result.read = [read = views.read, paint, gains](int index) {
    DepthView view = read(index);
    const double gain = gains[std::size_t(index) % gains.size()];
    for (int v = 0; v < view.picture.height(); ++v)
      for (int u = 0; u < view.picture.width(); ++u) {
        const float w = view.inverse_depth(u, v);
        if (!(w > 0)) continue;
        const Eigen::Array3d colour = paint(view.camera.back_project(u, v, 1 / double(w)));
        for (int k = 0; k < 3; ++k)
          view.picture(u, v, k) = std::uint8_t(std::lround(
              255 * srgb_from_linear(std::min(1.0, gain * linear_from_srgb(colour[k] / 255)))));
      }
    return view;
  };
  return result;
}

SurfaceMesh smooth_mesh(const DepthViews& views) {
  CloudOptions options;
  options.voxel = 0.06;
  PointCloud cloud;
  build_cloud(views, options, [&](const PointCloud& tile) { append(cloud, tile); }, {});
  return cleaned(poisson_mesh(cloud, {}, {}), {}, nullptr);
}

Eigen::Array3d colour_at(const SurfaceTexture& texture, const Eigen::Vector2f& place) {
  const Image<std::uint8_t>& picture = texture.picture;
  const double u =
      std::clamp(double(place.x()) * picture.width() - 0.5, 0.0, picture.width() - 1.0);
  const double v =
      std::clamp(double(place.y()) * picture.height() - 0.5, 0.0, picture.height() - 1.0);
  const int u0 = int(u), v0 = int(v);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int y = v0; y <= std::min(v0 + 1, picture.height() - 1); ++y)
    for (int x = u0; x <= std::min(u0 + 1, picture.width() - 1); ++x)
      sum += (1 - std::abs(u - x)) * (1 - std::abs(v - y)) *
             Eigen::Array3d(picture(x, y, 0), picture(x, y, 1), picture(x, y, 2));
  return sum;
}

Eigen::Vector3d middle_of(const SurfaceMesh& mesh, std::size_t face) {
  const auto [a, b, c] = mesh.faces[face];
  return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]).cast<double>() / 3 +
         mesh.origin;
}

Eigen::Array3d colour_of(const SurfaceTexture& texture, std::size_t face) {
  const auto& corners = texture.corners[face];
  return colour_at(texture, (corners[0] + corners[1] + corners[2]) / 3);
}

/// How far colours in the middle of the faces are from the paint: mean over faces and channels.
double mean_error(const SurfaceMesh& mesh, const SurfaceTexture& texture, const Paint& paint) {
  double sum = 0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    sum += (colour_of(texture, face) - paint(middle_of(mesh, face))).abs().mean();
  return sum / double(mesh.faces.size());
}

/// How far the two sides of seams are apart: mean over edges whose faces have other places there.
double mean_jump(const SurfaceMesh& mesh, const SurfaceTexture& texture, int* count) {
  using Places = std::pair<Eigen::Vector2f, Eigen::Vector2f>;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Places> sides;
  double sum = 0;
  *count = 0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3;
      const std::uint32_t a = mesh.faces[face][i], b = mesh.faces[face][k];
      Places places{texture.corners[face][i], texture.corners[face][k]};
      if (a > b) std::swap(places.first, places.second);
      const auto [found, is_new] = sides.emplace(std::minmax(a, b), places);
      if (is_new || found->second == places) continue;
      sum += (colour_at(texture, (places.first + places.second) / 2) -
              colour_at(texture, (found->second.first + found->second.second) / 2))
                 .abs()
                 .mean();
      ++*count;
    }
  return sum / *count;
}

TEST(Texture, HasTheColoursOfTheSceneAndPlacesInThePicture) {
  for (const Solid& solid : {sphere(), box(), tilted_planes()}) {
    SCOPED_TRACE(solid.name);
    const DepthViews views = painted(views_of(solid, cameras_on_an_arc(5, kSize)), stripes);
    const SurfaceMesh mesh = cleaned(grid_mesh(views, {}, nullptr, {}), {}, nullptr);
    TextureCounts counts;
    const SurfaceTexture texture = texture_of(mesh, views, {}, &counts, {});
    ASSERT_EQ(texture.corners.size(), mesh.faces.size());
    for (const auto& corners : texture.corners)
      for (const Eigen::Vector2f& place : corners) {
        ASSERT_GE(place.minCoeff(), 0);
        ASSERT_LE(place.maxCoeff(), 1);
      }
    EXPECT_LT(mean_error(mesh, texture, stripes), 2.5);
    EXPECT_LT(counts.unseen_area, 0.01);
    EXPECT_EQ(counts.scale, 1);
    EXPECT_LT(counts.largest_gain, 1.03);
  }
}

TEST(Texture, IsFinerThanTheMesh) {
  const DepthViews views = painted(views_of(tilted_planes(), cameras_on_an_arc(3, kSize)), stripes);
  const SurfaceMesh mesh =
      cleaned(grid_mesh(views, {}, nullptr, {}),
              {.least_faces = 50, .hole_edges = 0, .most_faces = 300}, nullptr);
  const SurfaceTexture texture = texture_of(mesh, views, {}, nullptr, {});
  double flat = 0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (const std::uint32_t corner : mesh.faces[face])
      for (int k = 0; k < 3; ++k) sum[k] += mesh.colours[corner][std::size_t(k)] / 3.0;
    flat += (sum - stripes(middle_of(mesh, face))).abs().mean() / double(mesh.faces.size());
  }
  EXPECT_LT(mean_error(mesh, texture, stripes), 0.5 * flat);
}

TEST(Texture, LevelsTwoExposures) {
  const std::vector<Camera> cameras = cameras_all_around(16, kSize);
  const DepthViews views = painted(views_of(sphere(), cameras), stripes, {0.8, 0.5});
  const SurfaceMesh mesh = smooth_mesh(views);
  int seams = 0;
  TextureOptions plain;
  plain.levels_seams = false;
  const double before = mean_jump(mesh, texture_of(mesh, views, plain, nullptr, {}), &seams);
  EXPECT_GT(seams, 100);
  EXPECT_GT(before, 10);
  TextureCounts counts;
  const SurfaceTexture texture = texture_of(mesh, views, {}, &counts, {});
  EXPECT_LT(mean_jump(mesh, texture, &seams), 2);
  EXPECT_GT(counts.views, 3);
  // Between the two exposures: their geometric mean is 0.63.
  EXPECT_NEAR(counts.largest_gain, std::sqrt(0.8 / 0.5), 0.05);
  const Paint between = [](const Eigen::Vector3d& x) -> Eigen::Array3d {
    return stripes(x).unaryExpr([](double value) {
      return 255 * srgb_from_linear(std::sqrt(0.8 * 0.5) * linear_from_srgb(value / 255));
    });
  };
  EXPECT_LT(mean_error(mesh, texture, between), 5);
}

TEST(Texture, TakesNothingFromWhatHidesASurface) {
  const Paint paint = [](const Eigen::Vector3d& x) -> Eigen::Array3d {
    return x.z() < 0.4 ? Eigen::Array3d(230, 20, 20) : Eigen::Array3d(20, 20, 230);
  };
  const DepthViews views = painted(views_of(rod(), cameras_on_an_arc(7, kSize)), paint);
  SurfaceMesh mesh = cleaned(grid_mesh(views, {}, nullptr, {}), {}, nullptr);
  const auto wrong = [&](const SurfaceMesh& surface) {
    const SurfaceTexture texture = texture_of(surface, views, {}, nullptr, {});
    int wall = 0, red = 0;
    for (std::size_t face = 0; face < surface.faces.size(); ++face)
      if (middle_of(surface, face).z() > 0.7) {
        ++wall;
        red += colour_of(texture, face)[0] > 120;
      }
    EXPECT_GT(wall, 1000);
    return red;
  };
  EXPECT_EQ(wrong(mesh), 0);
  // The views' own depth knows what hides a surface that the mesh is without.
  std::erase_if(mesh.faces, [&](const auto& face) { return mesh.positions[face[0]].z() < 0.4f; });
  EXPECT_EQ(wrong(mesh), 0);
}

TEST(Texture, TakesNothingFromMasks) {
  const Paint bright = [](const Eigen::Vector3d&) { return Eigen::Array3d(200, 210, 220); };
  DepthViews views = painted(views_of(tilted_planes(), cameras_on_an_arc(3, kSize)), bright);
  const SurfaceMesh mesh = cleaned(grid_mesh(views, {}, nullptr, {}), {}, nullptr);
  views.read = [read = views.read](int index) {
    DepthView view = read(index);
    for (int v = 0; v < view.camera.height; ++v)
      for (int u = 0; u < 12; ++u) {
        view.inverse_depth(u, v) = kNoEstimate;
        for (int c = 0; c < 3; ++c) view.picture(u, v, c) = 0;
      }
    return view;
  };
  const SurfaceTexture texture = texture_of(mesh, views, {}, nullptr, {});
  int dark = 0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    dark += colour_of(texture, face)[0] < 120;
  EXPECT_LT(dark, 0.002 * double(mesh.faces.size()));
}

TEST(Texture, WhatNoViewSeesHasTheColoursOfItsVertices) {
  const DepthViews views = painted(views_of(tilted_planes(), cameras_on_an_arc(3, kSize)), stripes);
  SurfaceMesh mesh = cleaned(grid_mesh(views, {}, nullptr, {}), {}, nullptr);
  const std::size_t seen = mesh.faces.size();
  const auto first = std::uint32_t(mesh.positions.size());
  for (const float x : {0.0f, 1.0f, 2.0f}) {
    mesh.positions.emplace_back(x, x * x, -20.0f);  // behind all cameras
    mesh.normals.emplace_back(0, 0, 1);
    mesh.colours.push_back({255, 0, 102});
  }
  mesh.faces.push_back({first, first + 1, first + 2});
  TextureCounts counts;
  const SurfaceTexture texture = texture_of(mesh, views, {}, &counts, {});
  EXPECT_GE(counts.unseen, 1u);
  EXPECT_LT(counts.unseen, 1 + seen / 100);
  EXPECT_GT(counts.unseen_area, 0);
  const Eigen::Array3d colour = colour_of(texture, seen);
  EXPECT_TRUE((colour - Eigen::Array3d(255, 0, 102)).abs().maxCoeff() <= 1) << colour.transpose();
}

TEST(Texture, IsScaledDownToItsSize) {
  const DepthViews views = painted(views_of(box(), cameras_all_around(12, kSize)), stripes);
  const SurfaceMesh mesh = smooth_mesh(views);
  TextureCounts counts;
  TextureOptions options;
  options.most_px = 128;
  const SurfaceTexture texture = texture_of(mesh, views, options, &counts, {});
  EXPECT_LE(std::max(texture.picture.width(), texture.picture.height()), 128);
  EXPECT_LT(counts.scale, 0.9);
  EXPECT_GT(counts.scale, 0.2);
  EXPECT_LT(mean_error(mesh, texture, stripes), 12);
}

TEST(Texture, FarFromTheOriginItIsTheSame) {
  const Eigen::Vector3d far(500123.25, 4649776.5, 210);
  const DepthViews near = painted(views_of(box(), cameras_on_an_arc(5, kSize)), stripes);
  DepthViews moved = near;
  const auto move = [far](Camera camera) {
    camera.translation -= camera.rotation * far;
    return camera;
  };
  for (Camera& camera : moved.cameras) camera = move(camera);
  moved.read = [read = near.read, move](int index) {
    DepthView view = read(index);
    view.camera = move(view.camera);
    return view;
  };
  const SurfaceMesh mesh = cleaned(grid_mesh(moved, {}, nullptr, {}), {}, nullptr);
  EXPECT_GT(mesh.origin.norm(), 1000);
  const Paint paint = [far](const Eigen::Vector3d& x) { return stripes(x - far); };
  EXPECT_LT(mean_error(mesh, texture_of(mesh, moved, {}, nullptr, {}), paint), 2.5);
}

TEST(Texture, WhatGivesNoneIsNamed) {
  const DepthViews views = views_of(tilted_planes(), cameras_on_an_arc(3, 31));
  const SurfaceMesh mesh = grid_mesh(views, {}, nullptr, {});
  TextureOptions options;
  options.most_px = 63;
  expect_error(ErrorCode::kInvalidArgument, {"most_px", "63"},
               [&] { texture_of(mesh, views, options, nullptr, {}); });
  expect_error(ErrorCode::kInvalidArgument, {"without triangles"},
               [&] { texture_of({}, views, {}, nullptr, {}); });
  RunControl control;
  control.cancel();
  expect_error(ErrorCode::kCancelled, {"stopped"},
               [&] { texture_of(mesh, views, {}, nullptr, control); });
}

}  // namespace
}  // namespace gigaray
