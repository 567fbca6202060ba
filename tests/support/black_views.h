// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "gigaray/core/light_field.h"

namespace gigaray::testing_support {

/// A row of black pictures: a light field to make mistakes with.
inline LightField black_views(int views, int width = 7, int height = 5) {
  LightField field;
  field.width = width;
  field.height = height;
  for (int i = 0; i < views; ++i) field.views.push_back({"v" + std::to_string(i), double(i), 0});
  field.pixels = pixels_in_memory(
      std::vector<Image<std::uint16_t>>(views, Image<std::uint16_t>(width, height, 3)), 8);
  return field;
}

}  // namespace gigaray::testing_support
