// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "gigaray/core/image.h"

namespace gigaray {

/// The picture resampled at the positions of a map (CV_32FC2, px) with the Lanczos kernel of three
/// lobes, values clamped to 0 … most; beyond its border the picture goes on as its last pixels.
/// Positions count to 1/1024 px: cv::remap rounds them to 1/32 px, which disparities of a hundredth
/// of a pixel would show. On all cores.
Image<std::uint16_t> resampled_lanczos(const Image<std::uint16_t>& picture, const cv::Mat& map,
                                       int most);

}  // namespace gigaray
