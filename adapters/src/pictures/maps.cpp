// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/maps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "files/text.h"
#include "gigaray/adapters/depth_colours.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

constexpr double kSamples = 65534;  // 1 … 65535 stand for values, 0 for NaN

void check_range(const FloatMap& map, DisparityRange range) {
  require_argument(map.channels() == 1 && !map.empty(), "map: one channel and pixels are needed");
  require_argument(range.min < range.max && std::isfinite(range.max - range.min),
                   "range: two finite numbers, the smaller first, are needed");
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

std::array<Rgb8, 256> depth_colours() {
  cv::Mat levels(1, 256, CV_8U);
  std::iota(levels.begin<std::uint8_t>(), levels.end<std::uint8_t>(), std::uint8_t(0));
  cv::Mat bgr;
  cv::applyColorMap(levels, bgr, cv::COLORMAP_TURBO);
  std::array<Rgb8, 256> colours;
  for (int i = 0; i < 256; ++i)
    for (int c = 0; c < 3; ++c)
      colours[std::size_t(i)][std::size_t(c)] = bgr.at<cv::Vec3b>(0, i)[2 - c];
  return colours;
}

void write_depth_picture(const std::filesystem::path& path, const FloatMap& map,
                         DisparityRange range) {
  check_range(map, range);
  const std::array<Rgb8, 256> colours = depth_colours();
  Image<std::uint16_t> picture(map.width(), map.height(), 3);
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u) {
      const double share = (map(u, v) - range.min) / (range.max - range.min);
      if (std::isnan(share)) continue;
      const Rgb8& colour = colours[std::size_t(std::lround(255 * std::clamp(share, 0.0, 1.0)))];
      std::copy(colour.begin(), colour.end(), &picture(u, v));
    }
  write_png(path, picture, 8);
}

}  // namespace gigaray
