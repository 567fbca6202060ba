// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/baselines/pair.h"

namespace gigaray::baselines {

/// Neighbours p, q pay weight · min(|label p − label q|, most_step).
struct Smoothness {
  cv::Mat right, down;  ///< weight of a pixel with its right and lower neighbour, CV_32F
  int most_step = 1;
};

/// Labels (CV_32S) that make the cost of pixels and neighbours small: alpha expansion (Boykov,
/// Veksler and Zabih 2001), one minimum cut per label by OpenCV's max-flow, from `labels` on, for
/// so many rounds over all labels or until a round changes nothing.
cv::Mat expanded(cv::Mat labels, const Volume& costs, const Smoothness& smoothness, int rounds,
                 const RunControl& control);

}  // namespace gigaray::baselines
