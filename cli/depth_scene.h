// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <functional>

#include "gigaray/camera.h"
#include "gigaray/light_field.h"

namespace gigaray::cli {

/// Pictures and depth of all views: an output folder of `gigaray depth` or a .grl file.
struct DepthScene {
  std::filesystem::path result;
  LightField light_field;
  DisparityRange range;                     ///< of disparities, or what was searched
  std::function<FloatMap(int)> disparity;   ///< of a view, unit of ViewDepth
  std::function<FloatMap(int)> confidence;  ///< empty: nothing is known of it
  std::function<LightField()> open_input;   ///< all views, also those left out; may be empty
};

/// input: where the pictures are, when they are no more where they were; may be empty.
/// min_confidence: estimates that are less sure are left out.
DepthScene open_depth_scene(const std::filesystem::path& result, const std::filesystem::path& input,
                            double min_confidence);

/// A view of the input with its camera, to compare with.
struct RealView {
  Camera camera;
  Image<std::uint16_t> picture;
  Mask shown;  ///< 0 where the picture shows nothing of the scene; empty: it does everywhere
};

/// A view with its picture as large as its camera.
RealView real_view(const LightField& light_field, int view, const Camera& camera);

}  // namespace gigaray::cli
