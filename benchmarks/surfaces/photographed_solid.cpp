// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "surfaces/photographed_solid.h"

#include <array>
#include <memory>

#include "gigaray/core/parallel.h"
#include "gigaray/engine/reconstruct.h"

namespace gigaray::benchmarks {
namespace {

using solids::Solid;

constexpr double kRoom = 8;       // radius; the cameras are 3.2 from the middle
constexpr double kCropped = 2.5;  // from the middle: beyond is the room
constexpr int kSamples = 3;       // rays per pixel and axis

/// Waves in all directions, the shortest a few pixels long.
class Texture {
 public:
  Texture() {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    for (Wave& wave : waves_) {
      const double length = 0.07 * std::pow(16, uniform(random));
      wave.way = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized() * 2 *
                 std::numbers::pi / length;
      wave.phase = 2 * std::numbers::pi * uniform(random);
      for (double& weight : wave.weight) weight = normal(random);
    }
  }
  Eigen::Array3d at(const Eigen::Vector3d& place) const {
    Eigen::Array3d value = Eigen::Array3d::Zero();
    for (const Wave& wave : waves_)
      value += std::sin(wave.way.dot(place) + wave.phase) *
               Eigen::Array3d(wave.weight[0], wave.weight[1], wave.weight[2]);
    return (0.5 + 0.11 * value).cwiseMax(0).cwiseMin(1);
  }

 private:
  struct Wave {
    Eigen::Vector3d way;
    double phase;
    std::array<double, 3> weight;
  };
  std::array<Wave, 24> waves_;
};

Eigen::Vector3d seen_at(const Solid& solid, const Camera& camera, double u, double v) {
  const Eigen::Vector3d eye = camera.position(),
                        way = (camera.back_project(u, v, 1) - eye).normalized();
  double distance = 0.3;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d place = eye + distance * way;
    const double gap = std::min(solid.distance(place), kRoom - place.norm());
    if (gap < 1e-5) break;
    distance += gap;
  }
  return eye + distance * way;
}

Image<std::uint16_t> picture_of(const Solid& solid, const Camera& camera, const Texture& texture) {
  Image<std::uint16_t> picture(camera.width, camera.height, 3);
  parallel_for(
      camera.height,
      [&](int v) {
        for (int u = 0; u < camera.width; ++u) {
          Eigen::Array3d sum = Eigen::Array3d::Zero();
          for (int y = 0; y < kSamples; ++y)
            for (int x = 0; x < kSamples; ++x) {
              const double du = (x + 0.5) / kSamples - 0.5, dv = (y + 0.5) / kSamples - 0.5;
              const Eigen::Vector3d place = seen_at(solid, camera, u + du, v + dv);
              // The room is three times as far.
              sum += texture.at(place.norm() > kCropped ? Eigen::Vector3d(place / 3) : place);
            }
          for (int c = 0; c < 3; ++c)
            picture(u, v, c) =
                std::uint16_t(std::lround(255 * sum[c] / double(kSamples * kSamples)));
        }
      },
      [](int) {});
  return picture;
}

}  // namespace

LightField photographed(const Solid& solid, std::vector<Camera> cameras) {
  const Texture texture;
  LightField light_field;
  light_field.kind = LightFieldKind::kUnstructured;
  light_field.width = cameras.front().width;
  light_field.height = cameras.front().height;
  std::vector<Image<std::uint16_t>> pictures;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    cameras[i].inverse_depth = InverseDepthRange{0.08, 0.6};
    light_field.views.push_back({"view_" + std::to_string(i)});
    pictures.push_back(picture_of(solid, cameras[i], texture));
  }
  light_field.pixels = pixels_in_memory(std::move(pictures), 8);
  light_field.cameras = std::move(cameras);
  light_field.format = "solid";
  place_by_cameras(light_field);
  return light_field;
}

DepthViews computed_views(const Solid& solid, std::vector<Camera> cameras) {
  const LightField light_field = photographed(solid, cameras);
  Reconstruction result = reconstruct(light_field, auto_options(), {}, {});
  auto kept = std::make_shared<std::vector<DepthView>>();
  for (int i = 0; i < int(cameras.size()); ++i) {
    ViewDepth depth = result.view(i);
    DepthView view{cameras[i], read_view(light_field, i), std::move(depth.disparity),
                   std::move(depth.confidence)};
    // Beside silhouettes pixels show both, and depth may be either's.
    for (int v = 0; v < view.inverse_depth.height(); ++v)
      for (int u = 0; u < view.inverse_depth.width(); ++u) {
        float& w = view.inverse_depth(u, v);
        if (seen_at(solid, cameras[i], u, v).norm() > kCropped ||
            cameras[i].back_project(u, v, 1 / double(w)).norm() > kCropped)
          w = kNoEstimate;
      }
    kept->push_back(std::move(view));
  }
  return {std::move(cameras), [kept](int view) { return (*kept)[view]; }};
}

}  // namespace gigaray::benchmarks
