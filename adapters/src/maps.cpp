// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/maps.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "gigaray/adapters/pictures.h"
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
  Image<std::uint16_t> samples(map.width(), map.height());
  std::transform(map.begin(), map.end(), samples.begin(), [&](float value) {
    const double steps = (value - range.min) / scale.scale;
    return std::isnan(steps) ? 0 : std::uint16_t(1 + std::lround(std::clamp(steps, 0.0, kSamples)));
  });
  write_png(path, samples, 16);
  return scale;
}

void write_depth_picture(const std::filesystem::path& path, const FloatMap& map,
                         DisparityRange range) {
  check_range(map, range);
  cv::Mat levels(map.height(), map.width(), CV_8U);
  std::transform(map.begin(), map.end(), levels.begin<std::uint8_t>(), [&](float value) {
    const double share = (value - range.min) / (range.max - range.min);
    return std::isnan(share) ? 0 : std::uint8_t(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  });
  cv::Mat bgr;
  cv::applyColorMap(levels, bgr, cv::COLORMAP_TURBO);
  Image<std::uint16_t> picture(map.width(), map.height(), 3);
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u)
      for (int c = 0; c < 3; ++c)
        picture(u, v, c) = std::isnan(map(u, v)) ? 0 : bgr.at<cv::Vec3b>(v, u)[2 - c];
  write_png(path, picture, 8);
}

}  // namespace gigaray
