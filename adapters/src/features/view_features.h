// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "gigaray/core/light_field.h"

namespace gigaray {

/// SIFT features of a view, brought to `largest` px of the longer side before.
struct ViewFeatures {
  std::vector<cv::Point2f> places;  ///< px of the view, pixel centres at integers
  cv::Mat descriptors;
  double scale = 1;  ///< px of the picture that was looked at, per px of the view
};
ViewFeatures features_of(const LightField& light_field, int view, int largest = 1000);

/// Places of one point in two views.
struct FeatureMatch {
  cv::Point2f a, b;
};

/// Features of a that one of b resembles clearly more than any other, as far as two pinhole views
/// of a still scene allow them all. Empty when these are fewer than kLeastMatches.
std::vector<FeatureMatch> matches_of(const ViewFeatures& a, const ViewFeatures& b);

inline constexpr std::size_t kLeastMatches = 30;

}  // namespace gigaray
