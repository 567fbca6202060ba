// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/lanczos.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace gigaray {
namespace {

constexpr int kLobes = 3, kTaps = 2 * kLobes, kPhases = 1024;
using Weights = std::array<float, kTaps>;

double lanczos(double x) {
  if (x == 0) return 1;
  if (std::abs(x) >= kLobes) return 0;
  const double p = std::numbers::pi * x;
  return kLobes * std::sin(p) * std::sin(p / kLobes) / (p * p);
}

/// Weights of the pixels −2 … 3 around a position at i / kPhases; their sum is 1.
const std::vector<Weights>& weights() {
  static const std::vector<Weights> table = [] {
    std::vector<Weights> all(kPhases + 1);
    for (int i = 0; i <= kPhases; ++i) {
      double sum = 0;
      std::array<double, kTaps> w;
      for (int tap = 0; tap < kTaps; ++tap)
        sum += w[tap] = lanczos(double(i) / kPhases - (tap - kLobes + 1));
      for (int tap = 0; tap < kTaps; ++tap) all[i][tap] = float(w[tap] / sum);
    }
    return all;
  }();
  return table;
}

/// The pixels that a position takes along one axis, and how much of each.
struct Taps {
  std::array<int, kTaps> at;
  const Weights* weight;

  Taps(float position, int size) {
    // Far beyond the border all pixels are the last one.
    position = std::clamp(position, -float(kTaps), float(size + kTaps));
    const int whole = int(std::floor(position));
    weight = &weights()[std::size_t(std::lround((position - float(whole)) * kPhases))];
    for (int tap = 0; tap < kTaps; ++tap)
      at[tap] = std::clamp(whole + tap - kLobes + 1, 0, size - 1);
  }
};

}  // namespace

Image<std::uint16_t> resampled_lanczos(const Image<std::uint16_t>& picture, const cv::Mat& map,
                                       int most) {
  constexpr int kChannels = 3;
  GIGARAY_CHECK(picture.channels() == kChannels && map.type() == CV_32FC2);
  Image<std::uint16_t> result(map.cols, map.rows, kChannels);
  cv::parallel_for_(cv::Range(0, map.rows), [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v)
      for (int u = 0; u < map.cols; ++u) {
        const auto& position = map.at<cv::Vec2f>(v, u);
        const Taps across(position[0], picture.width()), down(position[1], picture.height());
        std::array<float, kChannels> sum{};
        for (int j = 0; j < kTaps; ++j) {
          const std::uint16_t* row = picture.row(down.at[j]);
          std::array<float, kChannels> of_row{};
          for (int i = 0; i < kTaps; ++i)
            for (int c = 0; c < kChannels; ++c)
              of_row[c] += (*across.weight)[i] * float(row[kChannels * across.at[i] + c]);
          for (int c = 0; c < kChannels; ++c) sum[c] += (*down.weight)[j] * of_row[c];
        }
        for (int c = 0; c < kChannels; ++c)
          result(u, v, c) = std::uint16_t(std::lround(std::clamp(sum[c], 0.F, float(most))));
      }
  });
  return result;
}

}  // namespace gigaray
