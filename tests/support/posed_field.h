// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <utility>

#include "support/analytic_field.h"

namespace gigaray::testing_support {

struct PosedField {
  LightField light_field;
  std::vector<FloatMap> depth;  ///< exact, one per view, in its camera
};

/// Two textured planes seen by cameras anywhere: a wall at z = 10 everywhere, and before it a card
/// at z = 8.6, 0.4 units to both sides of the z axis. Point-sampled at pixel centres; no detail is
/// finer than some 7 px. masked, if given: pixels (u, v) that show nothing, black.
template <class IsMasked>
PosedField posed_field(std::vector<Camera> cameras, std::vector<View> views, IsMasked is_masked) {
  constexpr double kWall = 10, kCard = 8.6, kHalfCard = 0.4;
  const WavePattern wall(3), card(8);
  const double scale = cameras.front().focal_u / kWall;  // px of texture per unit
  class MaskedPictures : public PixelSource {
   public:
    explicit MaskedPictures(std::vector<Image<std::uint16_t>> pictures)
        : pictures_(std::move(pictures)) {}
    Image<std::uint16_t> read(int view_idx) const override { return pictures_.at(view_idx); }
    int bit_depth() const override { return 8; }
    bool has_mask() const override { return pictures_.front().channels() == 4; }

   private:
    std::vector<Image<std::uint16_t>> pictures_;
  };

  PosedField field;
  std::vector<Image<std::uint16_t>> pictures;
  bool any_masked = false;
  for (const Camera& camera : cameras)
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) any_masked = any_masked || is_masked(u, v);
  for (const Camera& camera : cameras) {
    Image<std::uint16_t> picture(camera.width, camera.height, any_masked ? 4 : 3);
    FloatMap depth(camera.width, camera.height);
    const Eigen::Vector3d eye = camera.position();
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = camera.back_project(u, v, 1) - eye;
        const auto meet = [&](double z) {
          return Eigen::Vector3d(eye + (z - eye.z()) / ray.z() * ray);
        };
        Eigen::Vector3d point = meet(kCard);
        const bool on_card = std::abs(point.x()) < kHalfCard && std::abs(point.y()) < kHalfCard;
        if (!on_card) point = meet(kWall);
        depth(u, v) = float(camera.project(point).z());
        const bool masked = is_masked(u, v);
        for (int c = 0; c < 3; ++c) {
          const double value = (on_card ? card : wall)(scale * point.x(), scale * point.y(), c);
          picture(u, v, c) = masked ? 0 : std::uint16_t(std::lround(255 * value));
        }
        if (any_masked) picture(u, v, 3) = masked ? 0 : 255;
      }
    pictures.push_back(std::move(picture));
    field.depth.push_back(std::move(depth));
  }
  LightField& light_field = field.light_field;
  light_field.kind = LightFieldKind::kUnstructured;
  light_field.width = cameras.front().width;
  light_field.height = cameras.front().height;
  light_field.views = std::move(views);
  light_field.cameras = std::move(cameras);
  light_field.pixels = std::make_shared<MaskedPictures>(std::move(pictures));
  light_field.format = "analytic";
  place_by_cameras(light_field);
  return field;
}

inline PosedField posed_field(std::vector<Camera> cameras, std::vector<View> views) {
  return posed_field(std::move(cameras), std::move(views), [](int, int) { return false; });
}

}  // namespace gigaray::testing_support
