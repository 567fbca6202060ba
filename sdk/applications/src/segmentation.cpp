// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/segmentation.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc.hpp>

#include "gigaray/parallel.h"

namespace gigaray {
namespace {

/// Values in, 0 or 1 out. By value: bytes that are written may alias anything else.
void segment_part(const float* values, std::uint8_t* inside, std::size_t count, float least,
                  float most) {
  for (std::size_t i = 0; i < count; ++i)
    inside[i] = std::uint8_t((values[i] >= least) & (values[i] <= most));
}

}  // namespace

void segment(const FloatMap& map, ValueInterval interval, Mask& mask) {
  if (mask.width() != map.width() || mask.height() != map.height())
    mask = Mask(map.width(), map.height());
  // Threads cost more than they bring for a small map.
  constexpr std::size_t kPart = std::size_t(1) << 22;
  const auto segment_from = [&](std::size_t begin) {
    segment_part(map.data() + begin, mask.data() + begin, std::min(map.size() - begin, kPart),
                 interval.least, interval.most);
  };
  const std::size_t parts = (map.size() + kPart - 1) / kPart;
  if (parts == 1) return segment_from(0);
  if (parts > 1)
    parallel_for(
        int(parts), [&](int part) { segment_from(std::size_t(part) * kPart); }, [](int) {});
}

FloatMap soft_matte(const Mask& mask, const Image<std::uint16_t>& picture, int bit_depth,
                    const MatteOptions& options) {
  if (options.radius < 1 || options.radius > 64 || !(options.contrast > 0))
    throw Error(ErrorCode::kInvalidArgument,
                "the soft edge has a radius of " + std::to_string(options.radius) +
                    " px and a contrast of " + std::to_string(options.contrast) +
                    "; the radius must be 1 … 64, the contrast above 0");
  GIGARAY_CHECK(picture.width() == mask.width() && picture.height() == mask.height());
  const cv::Mat hard(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
  const cv::Mat colours(picture.height(), picture.width(), CV_16UC3,
                        const_cast<std::uint16_t*>(picture.data()));
  cv::Mat guide, opacity, filtered;
  colours.convertTo(guide, CV_32F, 1.0 / ((1 << bit_depth) - 1));
  hard.convertTo(opacity, CV_32F);
  cv::ximgproc::guidedFilter(guide, opacity, filtered, options.radius,
                             options.contrast * options.contrast);
  const cv::Mat window = cv::getStructuringElement(
      cv::MORPH_ELLIPSE, {2 * options.radius + 1, 2 * options.radius + 1});
  cv::Mat grown, shrunk;
  cv::dilate(hard, grown, window);
  cv::erode(hard, shrunk, window);
  FloatMap matte(mask.width(), mask.height());
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u)
      matte(u, v) = grown.at<std::uint8_t>(v, u) == shrunk.at<std::uint8_t>(v, u)
                        ? float(mask(u, v))
                        : std::clamp(filtered.at<float>(v, u), 0.0f, 1.0f);
  return matte;
}

}  // namespace gigaray
