// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/smoothing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gigaray/core/arguments.h"

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

void check_sigma(double sigma) {
  constexpr double kMost = 1000;
  require_argument(sigma > 0 && sigma <= kMost, "sigma: must be above 0, 1000 at most");
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

class HalvedPixels : public PixelSource {
 public:
  explicit HalvedPixels(const LightField& light_field)
      : light_field_(smoothed(light_field, std::sqrt(0.5))) {}
  Image<std::uint16_t> read(int view_idx) const override {
    const Image<std::uint16_t> picture = read_view(light_field_, view_idx);
    const int channels = picture.channels();
    Image<std::uint16_t> half(half_of(picture.width()), half_of(picture.height()), channels);
    for (int v = 0; v < half.height(); ++v)
      for (int u = 0; u < half.width(); ++u)
        std::copy_n(picture.row(2 * v) + 2 * u * channels, channels, half.row(v) + u * channels);
    return half;
  }
  bool has_mask() const override { return light_field_.pixels->has_mask(); }
  int bit_depth() const override { return light_field_.pixels->bit_depth(); }

  static int half_of(int size) { return (size + 1) / 2; }

 private:
  LightField light_field_;
};

}  // namespace

Image<std::uint16_t> smooth_picture(const Image<std::uint16_t>& picture, double sigma) {
  check_sigma(sigma);
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
  check_sigma(sigma);
  require_argument(light_field.pixels != nullptr, "light_field.pixels: is null");
  light_field.pixels = std::make_shared<SmoothedPixels>(light_field.pixels, sigma);
  return light_field;
}

LightField halved(LightField light_field) {
  if (light_field.kind != LightFieldKind::kUnstructured)
    throw Error(ErrorCode::kInvalidArgument, "only light fields of posed cameras can be halved");
  light_field.pixels = std::make_shared<HalvedPixels>(light_field);
  for (int* size : {&light_field.width, &light_field.height}) *size = HalvedPixels::half_of(*size);
  for (Camera& camera : light_field.cameras) {
    for (int* size : {&camera.width, &camera.height}) *size = HalvedPixels::half_of(*size);
    for (double* length : {&camera.focal_u, &camera.focal_v, &camera.centre_u, &camera.centre_v})
      *length /= 2;
  }
  return light_field;
}

}  // namespace gigaray
