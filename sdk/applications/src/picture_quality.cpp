// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/picture_quality.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality.hpp>

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

/// The constants of OpenCV's similarity are those of values up to 255.
cv::Mat scaled_to_255(const Image<std::uint16_t>& picture, int bit_depth) {
  const cv::Mat values(picture.height(), picture.width(), CV_16UC(picture.channels()),
                       const_cast<std::uint16_t*>(picture.data()));
  cv::Mat scaled;
  values.convertTo(scaled, CV_32F, 255.0 / ((1 << bit_depth) - 1));
  return scaled;
}

}  // namespace

PictureQuality picture_quality(const Image<std::uint16_t>& picture,
                               const Image<std::uint16_t>& truth, int bit_depth,
                               const Mask& shown) {
  require_argument(picture.width() == truth.width() && picture.height() == truth.height() &&
                       picture.channels() == 3 && truth.channels() == 3 && !picture.empty(),
                   "picture, truth: must be of one size, with three channels");
  require_argument(bit_depth >= 1 && bit_depth <= 16, "bit_depth: must be 1 … 16");
  require_argument(shown.empty() || (shown.width() == picture.width() &&
                                     shown.height() == picture.height() && shown.channels() == 1),
                   "shown: must be as large as the picture, or empty");
  cv::Mat counts(picture.height(), picture.width(), CV_8U, cv::Scalar(255));
  for (std::size_t i = 0; i < shown.size(); ++i) counts.data[i] = shown.data()[i] ? 255 : 0;
  double squares = 0, number = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!counts.data[i / 3]) continue;
    const double difference = double(picture.data()[i]) - truth.data()[i];
    squares += difference * difference;
    ++number;
  }
  const double most = (1 << bit_depth) - 1;
  PictureQuality quality;
  quality.psnr = 10 * std::log10(most * most * number / squares);
  cv::Mat similarity;
  cv::quality::QualitySSIM::compute(scaled_to_255(truth, bit_depth),
                                    scaled_to_255(picture, bit_depth), similarity);
  constexpr int kWindow = 11;
  cv::Mat whole_windows;
  cv::erode(counts, whole_windows, cv::Mat::ones(kWindow, kWindow, CV_8U));
  const cv::Scalar mean = cv::mean(similarity, whole_windows);
  quality.ssim = (mean[0] + mean[1] + mean[2]) / 3;
  return quality;
}

}  // namespace gigaray
