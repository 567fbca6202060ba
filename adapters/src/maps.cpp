// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/maps.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "gigaray/adapters/atomic_output.h"
#include "png_bytes.h"
#include "text.h"

namespace gigaray {
namespace {

constexpr double kSamples = 65534;  // 1 … 65535 stand for values, 0 for NaN

void check_range(const FloatMap& map, DisparityRange range) {
  GIGARAY_CHECK(map.channels() == 1 && !map.empty());
  GIGARAY_CHECK(range.min < range.max);
}

}  // namespace

FloatMap read_float_map(const std::filesystem::path& path) {
  const std::string extension = lower(path.extension().string());
  if (extension == ".pfm") return read_pfm(path);
  if (extension == ".npy") return read_npy(path);
  if (extension == ".exr") return read_exr(path);
  throw Error(ErrorCode::kBadInput,
              path.string() + ": is no float map; it must end in .pfm, .npy or .exr");
}

Png16Scale write_png16(const std::filesystem::path& path, const FloatMap& map,
                       DisparityRange range) {
  check_range(map, range);
  const Png16Scale scale{range.min - (range.max - range.min) / kSamples,
                         (range.max - range.min) / kSamples};
  cv::Mat samples(map.height(), map.width(), CV_16U);
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u) {
      const double value = (map(u, v) - range.min) / scale.scale;
      samples.at<std::uint16_t>(v, u) =
          std::isnan(value) ? 0 : std::uint16_t(1 + std::lround(std::clamp(value, 0.0, kSamples)));
    }
  write_file_atomically(path, png_bytes(samples));
  return scale;
}

void write_depth_picture(const std::filesystem::path& path, const FloatMap& map,
                         DisparityRange range) {
  check_range(map, range);
  cv::Mat grey(map.height(), map.width(), CV_8U), nothing(map.height(), map.width(), CV_8U);
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u) {
      const double share = (map(u, v) - range.min) / (range.max - range.min);
      nothing.at<std::uint8_t>(v, u) = std::isnan(share) ? 255 : 0;
      grey.at<std::uint8_t>(v, u) =
          std::isnan(share) ? 0 : std::uint8_t(std::lround(255 * std::clamp(share, 0.0, 1.0)));
    }
  cv::Mat picture;
  cv::applyColorMap(grey, picture, cv::COLORMAP_TURBO);
  picture.setTo(cv::Scalar::all(0), nothing);
  write_file_atomically(path, png_bytes(picture));
}

}  // namespace gigaray
