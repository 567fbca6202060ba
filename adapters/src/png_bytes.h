// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace gigaray {

/// The content of a PNG file: 8 or 16 bit, grey or BGR.
std::string png_bytes(const cv::Mat& bgr);

}  // namespace gigaray
