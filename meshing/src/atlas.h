// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <vector>

#include "gigaray/core/surface_mesh.h"
#include "gigaray/core/surface_texture.h"
#include "view_gains.h"

namespace gigaray {

/// Pixels [u0, u1) × [v0, v1).
struct AtlasBox {
  int u0 = 0, v0 = 0, u1 = 0, v1 = 0;
  int width() const { return u1 - u0; }
  int height() const { return v1 - v0; }
};

/// A part of a picture and where it goes.
struct Crop {
  int view = 0;
  AtlasBox from;
  AtlasBox to;  ///< in the atlas, scaled
};

/// An atlas of crops of pictures, and of flat patches for faces that no view sees.
struct Atlas {
  double scale = 1;  ///< pixels of the atlas for one of a picture
  int width = 0, height = 0;
  std::vector<Crop> crops;
  std::vector<Rgb8> patches;  ///< colours; squares of kPatch px in rows, in `patch_box`
  AtlasBox patch_box;
  std::vector<std::uint32_t> place_of_face;  ///< index of its crop, or of its patch

  static constexpr int kPatch = 8;
};

/// Crops around the charts of each view, one for those that overlap, in an atlas that is as small
/// as it may be; scaled down where it would be wider or higher than `most_px`. in_picture: places
/// (px) of the corners of each face in its view's picture. Throws Error(kBadInput) when there are
/// too many charts for one atlas.
Atlas plan_atlas(const SurfaceMesh& mesh, const std::vector<Camera>& cameras,
                 const std::vector<int>& view_of_face, const std::vector<std::uint32_t>& charts,
                 const std::vector<std::array<Eigen::Vector2f, 3>>& in_picture, int most_px);

/// Draws a crop of the view's picture into the atlas; what is scaled down is averaged.
void draw_crop(const Atlas& atlas, const Crop& crop, const DepthView& view, const ValueTable& table,
               Image<std::uint8_t>& into);
void draw_patches(const Atlas& atlas, Image<std::uint8_t>& into);

/// The places of the faces' corners in the atlas, as SurfaceTexture::corners.
std::vector<std::array<Eigen::Vector2f, 3>> corners_in(
    const Atlas& atlas, const std::vector<int>& view_of_face,
    const std::vector<std::array<Eigen::Vector2f, 3>>& in_picture);

}  // namespace gigaray
