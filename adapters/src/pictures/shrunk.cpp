// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/shrunk.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "gigaray/core/error.h"
#include "gigaray/core/scaled_camera.h"

namespace gigaray {
namespace {

cv::Mat as_mat(Image<std::uint16_t>& image) {
  return {image.height(), image.width(), CV_16UC(image.channels()), image.data()};
}

class ShrunkPictures : public PixelSource {
 public:
  ShrunkPictures(LightField original, int width, int height)
      : original_(std::move(original)), width_(width), height_(height) {}

  int bit_depth() const override { return original_.pixels->bit_depth(); }
  bool has_mask() const override { return original_.pixels->has_mask(); }
  void let_go(int view_idx) const override { original_.pixels->let_go(view_idx); }

  Image<std::uint16_t> read(int view_idx) const override {
    Image<std::uint16_t> picture = read_view(original_, view_idx);
    Image<std::uint16_t> small(width_, height_, picture.channels());
    cv::Mat target = as_mat(small);
    cv::resize(as_mat(picture), target, target.size(), 0, 0, cv::INTER_AREA);
    const int shown = (1 << bit_depth()) - 1;
    for (int v = 0; has_mask() && v < height_; ++v)
      for (int u = 0; u < width_; ++u)
        if (small(u, v, 3) < shown) small(u, v, 3) = 0;
    return small;
  }

 private:
  LightField original_;
  int width_, height_;
};

}  // namespace

LightField shrunk(LightField light_field, int max_size) {
  constexpr int kLeast = 16;
  if (max_size < kLeast)
    throw Error(ErrorCode::kInvalidArgument, "pictures of at most " + std::to_string(max_size) +
                                                 " px are too small; the least is " +
                                                 std::to_string(kLeast));
  const int largest = std::max(light_field.width, light_field.height);
  if (largest <= max_size) return light_field;
  const auto size_of = [&](int size) {
    return std::max(1, int(std::lround(double(size) * max_size / largest)));
  };
  LightField small = light_field;
  small.width = size_of(light_field.width);
  small.height = size_of(light_field.height);
  small.pixels =
      std::make_shared<ShrunkPictures>(std::move(light_field), small.width, small.height);
  const double by_u = double(small.width) / light_field.width,
               by_v = double(small.height) / light_field.height;
  for (Camera& camera : small.cameras) camera = scaled(camera, by_u, by_v);
  if (small.rig.focal_px) *small.rig.focal_px *= by_u;
  if (auto& point = small.rig.principal_point)
    point = Eigen::Vector2d((point->x() + 0.5) * by_u - 0.5, (point->y() + 0.5) * by_v - 0.5);
  if (small.declared_range)
    small.declared_range =
        DisparityRange{by_u * small.declared_range->min, by_u * small.declared_range->max};
  return small;
}

}  // namespace gigaray
