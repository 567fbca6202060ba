// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "gigaray/applications/segmentation.h"

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

/// Blur of an edge between pixels, where the colours don't tell where it runs; px.
constexpr double kEdgeBlur = 0.7;
/// How much the spread of the colours on both sides counts against their distance.
constexpr float kSpread = 2;

cv::Mat with_three_channels(const cv::Mat& plane) {
  cv::Mat result;
  cv::merge(std::vector<cv::Mat>(3, plane), result);
  return result;
}

/// Mean over a window, RGB, and the spread about it (the sum of the channels' variances), of the
/// pixels that have weight 1.
struct LocalColours {
  cv::Mat mean, spread, weight;

  LocalColours(const cv::Mat& colours, const cv::Mat& weights, int radius) {
    const auto window_mean = [&](const cv::Mat& values) {
      cv::Mat result;
      cv::blur(values, result, {2 * radius + 1, 2 * radius + 1});
      return result;
    };
    weight = window_mean(weights);
    const cv::Mat divisor = with_three_channels(cv::max(weight, 1e-6));
    const cv::Mat weighted = colours.mul(with_three_channels(weights));
    mean = window_mean(weighted) / divisor;
    const cv::Mat variances = window_mean(weighted.mul(colours)) / divisor - mean.mul(mean);
    cv::transform(variances, spread, cv::Matx13f(1, 1, 1));
  }
};

/// Opacity of a pixel from its place on the line between the mean colours outside and inside, as
/// far as these tell inside from outside; else from the blurred mask.
float opacity(const cv::Vec3f& colour, const LocalColours& inside, const LocalColours& outside,
              float blurred, int v, int u, float contrast) {
  // One of them is not seen: nothing to compare with.
  if (inside.weight.at<float>(v, u) < 1e-4f || outside.weight.at<float>(v, u) < 1e-4f)
    return blurred;
  const cv::Vec3f zero = outside.mean.at<cv::Vec3f>(v, u);
  const cv::Vec3f line = inside.mean.at<cv::Vec3f>(v, u) - zero;
  const float length2 = line.dot(line);
  const float spread =
      std::max(inside.spread.at<float>(v, u) + outside.spread.at<float>(v, u), 0.0f);
  const float trust = length2 / (length2 + kSpread * spread + contrast * contrast);
  const float along = std::clamp((colour - zero).dot(line) / std::max(length2, 1e-9f), 0.0f, 1.0f);
  return trust * along + (1 - trust) * blurred;
}

}  // namespace

FloatMap soft_matte(const Mask& mask, const Image<std::uint16_t>& picture, int bit_depth,
                    const MatteOptions& options) {
  if (options.radius < 1 || options.radius > 64 || !(options.contrast > 0))
    throw Error(ErrorCode::kInvalidArgument,
                "the soft edge has a radius of " + std::to_string(options.radius) +
                    " px and a contrast of " + std::to_string(options.contrast) +
                    "; the radius must be 1 … 64, the contrast above 0");
  require_argument(picture.width() == mask.width() && picture.height() == mask.height(),
                   "mask: must be as large as the picture");
  const cv::Mat hard(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
  const cv::Mat window = cv::getStructuringElement(
      cv::MORPH_ELLIPSE, {2 * options.radius + 1, 2 * options.radius + 1});
  cv::Mat grown, shrunk;
  cv::dilate(hard, grown, window);
  cv::erode(hard, shrunk, window);

  cv::Mat colours, weights, blurred;
  cv::Mat(picture.height(), picture.width(), CV_16UC3, const_cast<std::uint16_t*>(picture.data()))
      .convertTo(colours, CV_32F, 1.0 / ((1 << bit_depth) - 1));
  hard.convertTo(weights, CV_32F);
  cv::GaussianBlur(weights, blurred, {}, kEdgeBlur);
  const LocalColours inside(colours, weights, options.radius);
  const LocalColours outside(colours, 1 - weights, options.radius);

  FloatMap matte(mask.width(), mask.height());
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u)
      matte(u, v) = grown.at<std::uint8_t>(v, u) == shrunk.at<std::uint8_t>(v, u)
                        ? float(mask(u, v))
                        : opacity(colours.at<cv::Vec3f>(v, u), inside, outside,
                                  blurred.at<float>(v, u), v, u, options.contrast);
  return matte;
}

}  // namespace gigaray
