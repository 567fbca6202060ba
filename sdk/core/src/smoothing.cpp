// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/smoothing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gigaray {
namespace {

/// Weights from the centre outwards; both sides together sum to 1.
std::vector<float> half_gaussian(double sigma) {
  const int radius = std::max(1, int(std::ceil(3 * sigma)));
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += (i == 0 ? 1 : 2) * weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(float(weight / sum));
  return normalised;
}

class SmoothedPixels : public PixelSource {
 public:
  SmoothedPixels(std::shared_ptr<const PixelSource> pixels, double sigma)
      : pixels_(std::move(pixels)), sigma_(sigma) {}
  Image<std::uint16_t> read(int view_idx) const override {
    const Image<std::uint16_t> picture = pixels_->read(view_idx);
    Image<std::uint16_t> smooth = smooth_picture(picture, sigma_);
    for (int v = 0; has_mask() && v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u) smooth(u, v, 3) = picture(u, v, 3);
    return smooth;
  }
  bool has_mask() const override { return pixels_->has_mask(); }
  int bit_depth() const override { return pixels_->bit_depth(); }
  void let_go(int view_idx) const override { pixels_->let_go(view_idx); }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  double sigma_;
};

}  // namespace

Image<std::uint16_t> smooth_picture(const Image<std::uint16_t>& picture, double sigma) {
  const std::vector<float> weights = half_gaussian(sigma);
  const int radius = int(weights.size()) - 1, width = picture.width(), height = picture.height();
  const int channels = picture.channels(), line = width * channels;
  Image<std::uint16_t> result(width, height, channels);
  std::vector<float> row(line);
  for (int v = 0; v < height; ++v) {
    for (int i = 0; i < line; ++i) row[i] = weights[0] * float(picture.row(v)[i]);
    for (int k = 1; k <= radius; ++k) {
      const auto* above = picture.row(std::max(v - k, 0));
      const auto* below = picture.row(std::min(v + k, height - 1));
      for (int i = 0; i < line; ++i) row[i] += weights[k] * (float(above[i]) + float(below[i]));
    }
    for (int u = 0; u < width; ++u)
      for (int c = 0; c < channels; ++c) {
        float sum = weights[0] * row[u * channels + c];
        for (int k = 1; k <= radius; ++k)
          sum += weights[k] * (row[std::max(u - k, 0) * channels + c] +
                               row[std::min(u + k, width - 1) * channels + c]);
        result.row(v)[u * channels + c] = std::uint16_t(std::lround(sum));
      }
  }
  return result;
}

LightField smoothed(LightField light_field, double sigma) {
  light_field.pixels = std::make_shared<SmoothedPixels>(light_field.pixels, sigma);
  return light_field;
}

}  // namespace gigaray
