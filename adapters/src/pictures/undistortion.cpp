// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/undistortion.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace gigaray {
namespace {

constexpr float kFarOutside = -1e4f;

template <class T>
cv::Mat as_mat(const Image<T>& image) {
  return {image.height(), image.width(), CV_MAKETYPE(cv::DataType<T>::depth, image.channels()),
          const_cast<T*>(image.data())};
}

}  // namespace

Undistortion::Undistortion(const Lens& lens, int width, int height)
    : lens_(lens, width, height), width_(width), height_(height) {}

cv::Vec2f Undistortion::source_of(int u, int v) const {
  const Eigen::Vector2d direction =
      (Eigen::Vector2d(u, v) - lens_.centre()).cwiseQuotient(lens_.focal());
  const auto source = lens_.distort(direction);
  // Positions far outside would overflow the fixed point numbers of remap.
  if (!source || source->cwiseAbs().maxCoeff() > 2.0 * std::max(width_, height_))
    return {kFarOutside, kFarOutside};
  return {float(source->x()), float(source->y())};
}

bool Undistortion::comes_from_inside(int u, int v) const {
  return is_inside(source_of(u, v), width_, height_);
}

bool Undistortion::fills_the_picture() const {
  // The map is continuous: when the border comes from inside, so does all within.
  for (int u = 0; u < width_; ++u)
    if (!comes_from_inside(u, 0) || !comes_from_inside(u, height_ - 1)) return false;
  for (int v = 0; v < height_; ++v)
    if (!comes_from_inside(0, v) || !comes_from_inside(width_ - 1, v)) return false;
  return true;
}

bool Undistortion::shows_anything() const {
  constexpr int kRaster = 32;
  for (int j = 0; j <= kRaster; ++j)
    for (int i = 0; i <= kRaster; ++i)
      if (comes_from_inside((width_ - 1) * i / kRaster, (height_ - 1) * j / kRaster)) return true;
  return false;
}

Undistortion::Map Undistortion::map() const {
  const std::lock_guard lock(mutex_);
  if (Map kept = map_.lock()) return kept;
  const auto map = std::make_shared<cv::Mat>(height_, width_, CV_32FC2);
  cv::parallel_for_(cv::Range(0, height_), [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v)
      for (int u = 0; u < width_; ++u) map->at<cv::Vec2f>(v, u) = source_of(u, v);
  });
  map_ = map;
  return map;
}

Image<std::uint16_t> resampled(const Image<std::uint16_t>& picture, const cv::Mat& map, int most) {
  Image<std::uint16_t> result(map.cols, map.rows, picture.channels());
  cv::Mat target = as_mat(result);
  cv::remap(as_mat(picture), target, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  const int channels = result.channels();
  for (int v = 0; v < map.rows; ++v)
    for (int u = 0; u < map.cols; ++u) {
      const bool inside = is_inside(map.at<cv::Vec2f>(v, u), picture.width(), picture.height());
      for (int c = 0; c < channels; ++c) {
        std::uint16_t& value = result(u, v, c);
        value = inside ? std::min(value, std::uint16_t(most)) : std::uint16_t(0);
      }
    }
  return result;
}

Mask resampled(const Mask& mask, const cv::Mat& map) {
  constexpr int kFull = 255;
  Mask full = mask;
  for (std::uint8_t& value : full) value = value ? kFull : 0;
  Mask result(map.cols, map.rows);
  cv::Mat target = as_mat(result);
  cv::remap(as_mat(full), target, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  for (int v = 0; v < map.rows; ++v)
    for (int u = 0; u < map.cols; ++u)
      result(u, v) = is_inside(map.at<cv::Vec2f>(v, u), mask.width(), mask.height()) &&
                     result(u, v) > kFull / 2;
  return result;
}

}  // namespace gigaray
