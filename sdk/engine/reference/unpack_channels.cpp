// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "unpack_channels.h"

namespace gigaray::reference {

void unpack_channels(const void* encoded, BandEncoding encoding, const std::vector<float>& table,
                     Band& band) {
  unpack_colours(encoded, encoding, table, band.rows, band);
  unpack_gradients(band.rows, band);
}

void unpack_colours(const void* encoded, BandEncoding encoding, const std::vector<float>& table,
                    RowRange rows, Band& band) {
  const int width = band.shape.width;
  const auto value = [&](std::size_t row, int view, int u, int c) -> float {
    const std::size_t line = (row * band.num_views + view) * 3 * width;
    switch (encoding) {
      case BandEncoding::kBits8:
        return table[static_cast<const std::uint8_t*>(encoded)[line + 3 * u + c]];
      case BandEncoding::kBits16:
        return table[static_cast<const std::uint16_t*>(encoded)[line + 3 * u + c]];
      case BandEncoding::kFloat:
        break;
    }
    return static_cast<const float*>(encoded)[line + std::size_t(c) * width + u];
  };
  for (int v = rows.begin; v < rows.end; ++v)
    for (int view = 0; view < band.num_views; ++view)
      for (int c = 0; c < 3; ++c)
        for (int u = 0; u < width; ++u)
          band.plane(view, v, c)[u] = value(v - rows.begin, view, u, c);
}

void mask_pixels(const std::uint8_t* mask, RowRange rows, Band& band) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int view = 0; view < band.num_views; ++view)
      for (int u = 0; u < band.shape.width; ++u)
        if (*mask++ == 0)
          for (int c = 0; c < 3; ++c) band.plane(view, v, c)[u] = kMaskedColour;
}

void unpack_gradients(RowRange rows, Band& band) {
  if (band.channels < 5) return;
  const int width = band.shape.width;
  const auto mean = [&](int view, int u, int v) {
    return (band.plane(view, v, 0)[u] + band.plane(view, v, 1)[u] + band.plane(view, v, 2)[u]) / 3;
  };
  for (int v = rows.begin; v < rows.end; ++v) {
    const int above = std::max(v - 1, band.rows.begin), below = std::min(v + 1, band.rows.end - 1);
    for (int view = 0; view < band.num_views; ++view) {
      for (int u = 0; u < width; ++u) {
        const int left = std::max(u - 1, 0), right = std::min(u + 1, width - 1);
        band.plane(view, v, 3)[u] = (mean(view, right, v) - mean(view, left, v)) / 2;
        band.plane(view, v, 4)[u] = (mean(view, u, below) - mean(view, u, above)) / 2;
      }
    }
  }
}

}  // namespace gigaray::reference
