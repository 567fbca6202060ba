// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Depth of pixels and cameras that a program has in memory.
#include <cmath>
#include <cstdio>

#include <vector>

#include "gigaray/engine/reconstruct.h"

namespace {

/// What a camera at x sees of a wall at depth 4: stands for the program's own pictures.
gigaray::Image<std::uint16_t> photograph(const gigaray::Camera& camera, double x) {
  gigaray::Image<std::uint16_t> picture(camera.width, camera.height, 3);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
      for (int c = 0; c < 3; ++c) {
        const double on_wall = u + camera.focal_u * x / 4;
        picture(u, v, c) = std::uint16_t(
            std::lround(127 + 60 * std::sin(0.9 * on_wall + c) + 60 * std::sin(0.3 * on_wall + v)));
      }
  return picture;
}

}  // namespace

int main() {
  gigaray::LightField light_field;
  light_field.kind = gigaray::LightFieldKind::kUnstructured;
  light_field.width = 96;
  light_field.height = 64;
  std::vector<gigaray::Image<std::uint16_t>> pictures;
  for (int i = 0; i < 6; ++i) {
    gigaray::Camera camera;
    camera.width = 96;
    camera.height = 64;
    camera.focal_u = camera.focal_v = 100;
    camera.centre_u = 47.5;
    camera.centre_v = 31.5;
    camera.translation = {-0.1 * i, 0, 0};  // it stands at x = 0.1 i
    light_field.cameras.push_back(camera);
    light_field.views.push_back({"photograph_" + std::to_string(i)});
    pictures.push_back(photograph(camera, 0.1 * i));
  }
  gigaray::place_by_cameras(light_field);
  light_field.pixels = gigaray::pixels_in_memory(pictures, 8);
  gigaray::DepthOptions options = gigaray::auto_options();
  options.disparity = gigaray::DisparityRange{1 / 8.0, 1 / 2.0};  // inverse depths
  const auto result = gigaray::reconstruct(light_field, options, {}, gigaray::RunControl());
  const float depth = 1 / result.view(3).disparity(48, 32);
  std::printf("depth in the middle of the wall: %.3f\n", depth);
  return std::abs(depth - 4) < 0.05 ? 0 : 1;
}
