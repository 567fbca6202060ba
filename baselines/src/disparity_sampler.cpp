// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/disparity_sampler.h"

namespace gigaray::baselines {

double disparity_of_inverse_depth(const LightField& light_field, int view) {
  if (light_field.kind != LightFieldKind::kUnstructured) return 1;
  LightField placed = light_field;
  return light_field.cameras[view].focal_u * place_by_cameras(placed);
}

AnySampler disparity_sampler(const LightField& light_field, int view) {
  LightField ranged = light_field;
  // Hypothesis 1 of unstructured views is the nearest end of the range: make that disparity 1.
  for (Camera& camera : ranged.cameras)
    camera.inverse_depth = {0, 1 / disparity_of_inverse_depth(light_field, view)};
  return make_sampler(ranged);
}

}  // namespace gigaray::baselines
