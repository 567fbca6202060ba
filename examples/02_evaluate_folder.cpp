// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Opens a light field of any format that the adapters know, computes the depth of the centre view
// with both presets and scores them against the truth.
//   02_evaluate_folder INPUT TRUTH
//   02_evaluate_folder hci/cotton hci/cotton/gt_disp_lowres.pfm
#include <cstdio>

#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/core/metrics.h"
#include "gigaray/engine/camera_order.h"
#include "gigaray/engine/reconstruct.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 02_evaluate_folder INPUT TRUTH\n");
    return 2;
  }
  try {
    const gigaray::RunControl control;
    gigaray::LightField light_field = gigaray::open_light_field(argv[1]);
    // Pictures without positions: the way the camera moved is assumed. reconstruct() checks it too,
    // at each call.
    gigaray::check_direction(light_field, control);
    const int centre = gigaray::centre_view(light_field);
    std::printf("%s, %s, %d views of %d x %d px\n", light_field.format.c_str(),
                gigaray::to_string(light_field.kind), light_field.num_views(), light_field.width,
                light_field.height);

    const gigaray::FloatMap truth = gigaray::read_float_map(argv[2]);
    std::printf("%-8s %10s %10s %10s %8s\n", "preset", "BadPix0.07", "BadPix0.03", "BadPix0.01",
                "MSEx100");
    for (const char* preset : {"paper", "auto"}) {
      gigaray::DepthOptions options = gigaray::preset_options(preset);
      options.views = {centre};
      gigaray::Reconstruction result = gigaray::reconstruct(light_field, options, {}, control);
      const gigaray::DisparityScores scores =
          gigaray::score_disparity(result.view(centre).disparity, truth);
      std::printf("%-8s %10.2f %10.2f %10.2f %8.2f\n", preset, scores.bad_pix_007,
                  scores.bad_pix_003, scores.bad_pix_001, scores.mse_x100);
    }
    return 0;
  } catch (const gigaray::Error& error) {
    std::fprintf(stderr, "02_evaluate_folder: %s\n", error.what());
    return 1;
  }
}
