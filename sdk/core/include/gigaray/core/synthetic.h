// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// What to render: a seeded scene seen by a rig of parallel pinhole views. The same options give
/// the same pixels on every machine.
struct SyntheticOptions {
  /// Name of the scene, one of synthetic_scene_names().
  std::string scene = "garden";
  int width = 352;   ///< px, 16 … 16384
  int height = 240;  ///< px, 16 … 16384
  int views_s = 17;  ///< views along s; 2 or more in one of the two directions
  int views_t = 1;   ///< views along t; 1 gives a 3D light field
  /// Disparity of the farthest and of the nearest surface, px per view step.
  DisparityRange disparity{-1.0, 1.0};
  double noise = 0;  ///< Standard deviation of Gaussian sensor noise on the encoded [0, 1] value.
  double outliers = 0;  ///< Share of views in which something that walks through is seen, 0 … 1.
  std::uint64_t seed = 1;
  int bit_depth = 8;  ///< 8 or 16
  int samples = 4;    ///< Rays per pixel and axis, 1 … 16, where a pixel sees an edge; inside a
                      ///< surface two are enough, because no texture is finer than three pixels.
                      ///< Disparity is exact for the ray through the pixel centre.

  void check() const;  ///< Throws Error(kInvalidArgument) naming the field and its value.
};

/// The light field with its exact disparity, one map per view, same order as the views. They are
/// numbered as the camera goes right, then down, which is the usual order of pictures; s and t rise
/// with the number (View). "view_007" in a row, "view_TT_SS" in a grid.
struct SyntheticLightField {
  LightField light_field;
  std::vector<FloatMap> disparity;  ///< px per view step, finite everywhere
};

/// "planes"  slanted, textured planes at several depths
/// "rods"    thin rods and a railing before a textured wall
/// "sphere"  a curved object before a slanted plane
/// "wall"    an untextured wall with a few textured objects
/// "specular" a glossy patch whose highlight moves with the view
/// "plaster" a corridor between sloping walls: one without texture, one of which is barely visible
/// "silhouettes" things before a wall of the same colours and texture
/// "wedges"  thin wedges before a slanted plane
/// "room"    inside a furnished room, 1 to 4 away: floor and walls at a slant, bare and dark parts
/// "figure"  a chair with thin bars, a ball, and nothing around them but white
/// "garden"  planes, rods, balls, a bare and a glossy surface in one picture; the demo
const std::vector<std::string>& synthetic_scene_names();

/// Renders every view, on all cores. Memory: 6 bytes per pixel and view plus one float map per
/// view.
SyntheticLightField render_synthetic(const SyntheticOptions& options, const RunControl& control);

/// What render_synthetic would return, without rendering: everything but the pixels.
LightField describe_synthetic(const SyntheticOptions& options);

/// Takes one finished view. Called from several threads at once, in any order.
using SyntheticViewSink =
    std::function<void(int view_idx, Image<std::uint16_t> picture, FloatMap disparity)>;

/// Renders view by view and keeps none: for light fields larger than memory. The same pixels as
/// render_synthetic. An exception of the sink stops the run and is thrown again.
void render_synthetic_views(const SyntheticOptions& options, const RunControl& control,
                            const SyntheticViewSink& sink);

}  // namespace gigaray
