// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>

#include "gigaray/adapters/lens.h"
#include "gigaray/core/image.h"

namespace gigaray {

/// Makes pictures of one lens those of a pinhole camera with the same focal lengths, principal
/// point and size. Thread-safe.
class Undistortion {
 public:
  /// Source position of every pixel, px, CV_32FC2; far outside where the lens shows nothing.
  using Map = std::shared_ptr<const cv::Mat>;

  /// For pictures of width x height px, which the lens is scaled to.
  Undistortion(const Lens& lens, int width, int height);

  /// Does every pixel come from inside of the source?
  bool fills_the_picture() const;
  /// Does any pixel come from inside of the source? Looks at a raster of them.
  bool shows_anything() const;

  /// Computed at the first call, and again when nobody has kept it.
  Map map() const;

 private:
  cv::Vec2f source_of(int u, int v) const;
  bool comes_from_inside(int u, int v) const;

  LensMap lens_;
  int width_, height_;
  mutable std::mutex mutex_;
  mutable std::weak_ptr<const cv::Mat> map_;
};

/// Is a source position within the area of the pixels?
inline bool is_inside(const cv::Vec2f& position, int width, int height) {
  return position[0] >= -0.5f && position[1] >= -0.5f && position[0] <= float(width) - 0.5f &&
         position[1] <= float(height) - 0.5f;
}

/// The picture resampled by the map, bicubic, values clamped to 0 … most; 0 where it comes from
/// outside. Any number of channels up to 4.
Image<std::uint16_t> resampled(const Image<std::uint16_t>& picture, const cv::Mat& map, int most);

/// A mask resampled by the map: 1 where more than half of it is, and the source is inside.
Mask resampled(const Mask& mask, const cv::Mat& map);

}  // namespace gigaray
