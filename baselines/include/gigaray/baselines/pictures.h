// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <opencv2/core.hpp>

#include "gigaray/core/light_field.h"

namespace gigaray::baselines {

/// A view as CV_8UC3, RGB. shown: CV_8U, 0 where the picture shows nothing of the scene; may be
/// null.
cv::Mat picture_of(const LightField& light_field, int view, cv::Mat* shown = nullptr);

/// CV_32F ↔ FloatMap.
FloatMap map_of(const cv::Mat& map);
cv::Mat mat_of(const FloatMap& map);

}  // namespace gigaray::baselines
