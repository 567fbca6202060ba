// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gigaray {

/// calib.txt of a rectified pair, for pictures of its own size.
struct StereoCalibration {
  double focal_px = 0;
  double centre_u = 0, centre_v = 0;  ///< principal point of the left picture, px as stated
  double baseline = 0;                ///< mm
  /// Principal point of the right picture less that of the left one along u, px: a point at
  /// disparity d is at the depth focal_px · baseline / (d + doffs).
  double doffs = 0;
  std::optional<double> disparities;  ///< ndisp: they lie from 0 to less than this
  int width = 0, height = 0;          ///< 0: not stated
};

/// Is a text such a file? Others are called calib.txt too.
bool is_stereo_calibration(std::string_view text);

/// Throws Error(kBadInput), beginning with `where`, for what is missing or no valid number.
StereoCalibration parse_stereo_calibration(std::string_view text, const std::string& where);

}  // namespace gigaray
