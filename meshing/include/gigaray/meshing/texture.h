// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>

#include "gigaray/core/api.h"
#include "gigaray/core/surface_mesh.h"
#include "gigaray/core/surface_texture.h"
#include "gigaray/meshing/depth_view.h"

namespace GIGARAY_API gigaray {

struct TextureOptions {
  int most_px = 4096;  ///< Width and height of the atlas at most. 64 … 32768
  /// Brings views of different exposure to one, and feathers what is left along the seams.
  bool levels_seams = true;
};

/// What became of the triangles.
struct TextureCounts {
  int views = 0;            ///< that a triangle takes its colours from
  std::size_t charts = 0;   ///< connected triangles with one view
  std::size_t unseen = 0;   ///< triangles that no view sees; they have the colour of their vertices
  double unseen_area = 0;   ///< their share of the area, [0, 1]
  double scale = 1;         ///< pixels of the atlas for one of a picture, (0, 1]
  double largest_gain = 1;  ///< what a view's linear light was multiplied with, or divided by
};

/// An atlas from the pictures of the views. A triangle is seen where it is whole in a picture and
/// neither hidden by the surface nor by what the view's own depth shows; of the views that show it
/// at least half as large as the best does, those are taken that show most of the surface, so that
/// triangles hang together in crops of few pictures. Exposures are levelled by one gain per view
/// and channel, from points that several views see, and the rest by offsets that fade away from
/// the seams. Pictures are read one at a time, each up to three times. Within a triangle the
/// picture is taken as affine, which shows where large triangles lie at a slant.
/// mesh: of `views`, not empty. counts: may be null. Takes views.size() + 150 bytes per face, 400
/// per vertex and 6 per pixel of the atlas. Throws Error(kInvalidArgument) for options and for a
/// mesh without faces, kBadInput when no view has an estimate or the atlas is too small for its
/// charts, kCancelled, and what `views` throws.
SurfaceTexture texture_of(const SurfaceMesh& mesh, const DepthViews& views,
                          const TextureOptions& options, TextureCounts* counts,
                          const RunControl& control);

}  // namespace gigaray
