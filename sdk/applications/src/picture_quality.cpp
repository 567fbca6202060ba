// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/picture_quality.h"

#include <cmath>
#include <opencv2/quality.hpp>

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
                               const Image<std::uint16_t>& truth, int bit_depth) {
  GIGARAY_CHECK(picture.width() == truth.width() && picture.height() == truth.height() &&
                picture.channels() == 3 && truth.channels() == 3);
  double squares = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double difference = double(picture.data()[i]) - truth.data()[i];
    squares += difference * difference;
  }
  const double most = (1 << bit_depth) - 1;
  PictureQuality quality;
  quality.psnr = 10 * std::log10(most * most * double(picture.size()) / squares);
  const cv::Scalar similarity = cv::quality::QualitySSIM::compute(
      scaled_to_255(truth, bit_depth), scaled_to_255(picture, bit_depth), cv::noArray());
  quality.ssim = (similarity[0] + similarity[1] + similarity[2]) / 3;
  return quality;
}

}  // namespace gigaray
