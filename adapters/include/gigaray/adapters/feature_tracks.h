// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gigaray/calibration/rail.h"
#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// Pictures in an order in which neighbours overlap.
struct PictureSeries {
  int count = 0;
  int bit_depth = 8;                                  ///< 8 or 16
  std::function<Image<std::uint16_t>(int idx)> read;  ///< RGB, 0 … 2^bit_depth − 1
};

struct FeatureTrackOptions {
  int max_size = 2400;      ///< px of the longer side; larger pictures are reduced before
  int max_features = 4000;  ///< per picture
  /// Pictures are matched with those that follow at these distances.
  std::vector<int> reach{1, 2, 4};
};

/// Scene points followed through pictures: SIFT features, matched both ways, kept where a pair of
/// pictures has one fundamental matrix, chained to tracks. Sightings are in the order of the
/// pictures, px of the full size, lens distortion and all. Wrong tracks remain, a few in a hundred.
/// stage: name of the work for control.progress. Errors of `read` pass through.
std::vector<Track> find_feature_tracks(const PictureSeries& pictures,
                                       const FeatureTrackOptions& options, const char* stage,
                                       const RunControl& control);

/// |v − v′| of features of neighbouring pictures, px; of 12 pairs at most, spread over the series.
ResidualStats measure_vertical_residual(const PictureSeries& pictures, const char* stage,
                                        const RunControl& control);

}  // namespace gigaray
