// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/pictures.h"

#include <algorithm>
#include <optional>

namespace gigaray::baselines {

cv::Mat picture_of(const LightField& light_field, int view, cv::Mat* shown) {
  Image<std::uint16_t> picture = read_view(light_field, view);
  std::optional<Mask> mask = take_mask(picture);
  if (shown && mask)
    *shown = cv::Mat(picture.height(), picture.width(), CV_8U, mask->data()).clone();
  else if (shown)
    *shown = cv::Mat(picture.height(), picture.width(), CV_8U, cv::Scalar(1));
  const double scale = 255.0 / double((1 << light_field.pixels->bit_depth()) - 1);
  cv::Mat result;
  cv::Mat(picture.height(), picture.width(), CV_16UC3, picture.data())
      .convertTo(result, CV_8U, scale);
  return result;
}

FloatMap map_of(const cv::Mat& map) {
  FloatMap result(map.cols, map.rows);
  for (int v = 0; v < map.rows; ++v) std::copy_n(map.ptr<float>(v), map.cols, result.row(v));
  return result;
}

cv::Mat mat_of(const FloatMap& map) {
  cv::Mat result(map.height(), map.width(), CV_32F);
  for (int v = 0; v < map.height(); ++v) std::copy_n(map.row(v), map.width(), result.ptr<float>(v));
  return result;
}

}  // namespace gigaray::baselines
