// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "workspace.h"

#include "gigaray/core/srgb.h"
#include "make_workspace.h"

namespace gigaray {

std::size_t pixel_bytes(BandEncoding encoding) {
  switch (encoding) {
    case BandEncoding::kBits8:
      return 3;
    case BandEncoding::kBits16:
      return 6;
    case BandEncoding::kFloat:
      break;
  }
  return 3 * sizeof(float);
}

std::vector<float> colour_table(int bit_depth, bool linear_rgb) {
  std::vector<float> table(std::size_t(1) << bit_depth);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double x = double(i) / double(table.size() - 1);
    table[i] = float(linear_rgb ? linear_from_srgb(x) : x);
  }
  return table;
}

}  // namespace gigaray
