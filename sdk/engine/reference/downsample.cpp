// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "downsample.h"

namespace gigaray::reference {

void downsample(const Band& band, RowRange small_rows, float* small) {
  std::array<float, 7> gaussian;
  double sum = 0;
  for (int k = -3; k <= 3; ++k) sum += std::exp(-k * k / (2 * 0.5));
  for (int k = -3; k <= 3; ++k) gaussian[k + 3] = float(std::exp(-k * k / (2 * 0.5)) / sum);

  const int small_width = (band.shape.width + 1) / 2;
  for (int row = small_rows.begin; row < small_rows.end; ++row) {
    for (int view = 0; view < band.num_views; ++view) {
      for (int c = 0; c < 3; ++c) {
        for (int u = 0; u < small_width; ++u) {
          float total = 0;
          for (int y = -3; y <= 3; ++y) {
            const int v = std::clamp(2 * row + y, 0, band.shape.height - 1);
            for (int x = -3; x <= 3; ++x)
              total += gaussian[y + 3] * gaussian[x + 3] *
                       band.plane(view, v, c)[std::clamp(2 * u + x, 0, band.shape.width - 1)];
          }
          *small++ = total;
        }
      }
    }
  }
}

}  // namespace gigaray::reference
