// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Renders a 3D light field in memory, computes the depth of its centre view and scores it.
//   01_synthetic_epi
#include <cstdio>

#include "gigaray/core/metrics.h"
#include "gigaray/core/synthetic.h"
#include "gigaray/engine/reconstruct.h"

int main() {
  try {
    gigaray::SyntheticOptions scene;
    scene.scene = "planes";
    scene.width = 160;
    scene.height = 120;
    scene.views_s = 9;

    // Ctrl-C and progress bars hang on this handle; here only the notes are shown.
    gigaray::RunControl control;
    control.on_message = [](const std::string& text) { std::printf("note: %s\n", text.c_str()); };
    const gigaray::SyntheticLightField truth = gigaray::render_synthetic(scene, control);
    const gigaray::LightField& light_field = truth.light_field;
    const int centre = gigaray::centre_view(light_field);

    gigaray::DepthOptions options = gigaray::auto_options();
    options.views = {centre};  // empty would mean all
    gigaray::Reconstruction result = gigaray::reconstruct(light_field, options, {}, control);
    const gigaray::ViewDepth depth = result.view(centre);

    const gigaray::DisparityScores scores =
        gigaray::score_disparity(depth.disparity, truth.disparity[centre]);
    std::printf("%d views of %d x %d px, %d hypotheses, %s\n", light_field.num_views(),
                light_field.width, light_field.height, result.hypotheses().count,
                result.device().c_str());
    for (const auto& [stage, seconds] : result.seconds())
      std::printf("  %-12s %.3f s\n", stage.c_str(), seconds);
    std::printf("BadPix0.07 %.2f %%, MSEx100 %.2f, filled %.1f %%\n", scores.bad_pix_007,
                scores.mse_x100, scores.filled);
    constexpr double kMostBad = 15;  // far from what a broken run gives
    return scores.bad_pix_007 < kMostBad ? 0 : 1;
  } catch (const gigaray::Error& error) {
    std::fprintf(stderr, "01_synthetic_epi: %s\n", error.what());
    return 1;
  }
}
