// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "gigaray/core/light_field.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/run_control.h"
#include "gigaray/samplers/any_sampler.h"
#include "reference/band.h"

namespace gigaray {

/// Rows of a view on which noise is measured, with what they reach in other views.
struct NoiseRows {
  AnySampler sampler;  ///< of these views: that one first, then those it is compared with
  int num_views = 0;
  std::vector<int> views;  ///< which these are
  std::vector<int> rows;   ///< v, evenly spread
  /// One of each row, or a single one where they reach much.
  std::vector<reference::Band> bands;

  const reference::Band& band_of(int i) const { return bands[bands.size() == 1 ? 0 : i]; }
};

/// reach: rows around each that are looked at, taps and gradients included. Of unstructured views,
/// where a row may need much of each, 9 are read, else 25. without: views that are not asked.
NoiseRows load_noise_rows(const LightField& light_field, int view,
                          const HypothesisRange& hypotheses, int num_rows, int reach,
                          const RunControl& control, const std::vector<int>& without = {});

/// How far a pixel is off what other views see.
struct PixelDistance {
  static constexpr float kColourCap = 0.3f, kGradientCap = 0.2f;
  float colour = kColourCap, gradient = kGradientCap;
};

/// Mean over the other views that see the point of a ray of view 0, each capped; empty: fewer than
/// half do. own: what the pixel itself is.
template <RaySampler S>
std::optional<PixelDistance> distance_of(const reference::Band& band, const S& sampler,
                                         const Ray& ray, const reference::Sample& own) {
  PixelDistance sum{0, 0};
  int count = 0;
  for (int other = 1; other < band.num_views; ++other) {
    const auto there = sampler.locate(0, other, ray);
    const auto sample =
        there ? reference::sample_at(band, other, there->u, there->v, true) : std::nullopt;
    if (!sample) continue;
    sum.colour += std::min(PixelDistance::kColourCap, reference::colour_distance(*sample, own));
    sum.gradient += std::min(PixelDistance::kGradientCap,
                             std::hypot((*sample)[3] - own[3], (*sample)[4] - own[4]));
    ++count;
  }
  if (count == 0 || 2 * count < band.num_views - 1) return std::nullopt;
  return PixelDistance{sum.colour / float(count), sum.gradient / float(count)};
}

/// The value that a share of all lies below; 0 of none. Reorders.
double percentile(std::vector<float>& values, double share);

}  // namespace gigaray
