// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gigaray/core/light_field.h"
#include "gigaray/core/metrics.h"
#include "gigaray/core/synthetic.h"
#include "gigaray/engine/reconstruct.h"

namespace gigaray::testing_support {

/// Views that a light field of the accuracy tests has.
enum class Rig {
  kRow,    ///< 25 in a row: 3D
  kCross,  ///< The middle row and column of 7 × 7: 4D
  kGrid    ///< 5 × 5
};

/// Small enough for a test, large enough for the 15 px that the metrics leave out.
inline SyntheticOptions small_scene(const std::string& scene, Rig rig, double noise) {
  SyntheticOptions options;
  options.scene = scene;
  options.width = 176;
  options.height = 128;
  options.noise = noise;
  options.views_s = rig == Rig::kRow ? 25 : rig == Rig::kCross ? 7 : 5;
  options.views_t = rig == Rig::kRow ? 1 : options.views_s;
  // The same parallax between the outermost views, whatever their number.
  const double most = 12.0 / (options.views_s - 1);
  options.disparity = {-most, most};
  return options;
}

inline SyntheticLightField render_scene(const std::string& scene, Rig rig, double noise) {
  SyntheticLightField field = render_synthetic(small_scene(scene, rig, noise), RunControl());
  if (rig != Rig::kCross) return field;
  std::vector<View> views;
  std::vector<Image<std::uint16_t>> pictures;
  std::vector<FloatMap> disparity;
  for (int i = 0; i < field.light_field.num_views(); ++i) {
    const View& view = field.light_field.views[i];
    if (view.s != 0 && view.t != 0) continue;
    views.push_back(view);
    pictures.push_back(field.light_field.pixels->read(i));
    disparity.push_back(std::move(field.disparity[i]));
  }
  field.light_field.pixels =
      pixels_in_memory(std::move(pictures), field.light_field.pixels->bit_depth());
  field.light_field.views = std::move(views);
  field.disparity = std::move(disparity);
  return field;
}

/// Scores of views computed with the default options; the disparity range is stated.
inline std::vector<DisparityScores> scores_of_views(const SyntheticLightField& field,
                                                    const std::vector<int>& views) {
  DepthOptions options = auto_options();
  options.views = views;
  Reconstruction result = reconstruct(field.light_field, options, {}, RunControl());
  std::vector<DisparityScores> scores;
  for (const int view : views)
    scores.push_back(score_disparity(result.view(view).disparity, field.disparity[view]));
  return scores;
}

}  // namespace gigaray::testing_support
