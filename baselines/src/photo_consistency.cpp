// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/photo_consistency.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "gigaray/baselines/disparity_sampler.h"
#include "gigaray/baselines/pictures.h"
#include "gigaray/core/parallel.h"

namespace gigaray::baselines {

double photo_consistency(const LightField& light_field, int view, const FloatMap& disparity,
                         int most_views) {
  cv::Mat shown;
  const cv::Mat reference = picture_of(light_field, view, &shown);
  const int width = disparity.width(), height = disparity.height();
  std::vector<int> others;
  for (int i = 0; i < light_field.num_views(); ++i)
    if (i != view) others.push_back(i);
  const int count = std::min(most_views, int(others.size()));
  const AnySampler any = disparity_sampler(light_field, view);
  const auto locate = [&](int other, const Ray& ray) {
    return std::visit([&](const auto& sampler) { return sampler.locate(view, other, ray); }, any);
  };
  std::vector<cv::Mat> gaps(count);
  parallel_for(
      count,
      [&](int k) {
        const int other = others[std::size_t(k) * others.size() / count];
        cv::Mat at_u(height, width, CV_32F), at_v(height, width, CV_32F), moved;
        for (int v = 0; v < height; ++v)
          for (int u = 0; u < width; ++u) {
            const double d = disparity(u, v);
            const auto at =
                std::isfinite(d) ? locate(other, {double(u), double(v), d}) : std::optional<Ray>();
            at_u.at<float>(v, u) = at ? float(at->u) : -1e6f;
            at_v.at<float>(v, u) = at ? float(at->v) : -1e6f;
          }
        cv::Mat shown_there;
        cv::remap(picture_of(light_field, other, &shown_there), moved, at_u, at_v, cv::INTER_LINEAR,
                  cv::BORDER_REPLICATE);
        gaps[k] = cv::Mat(height, width, CV_32F, cv::Scalar(kNoEstimate));
        for (int v = 0; v < height; ++v)
          for (int u = 0; u < width; ++u) {
            const float x = at_u.at<float>(v, u), y = at_v.at<float>(v, u);
            if (!(x >= 0 && y >= 0 && x <= float(width - 1) && y <= float(height - 1))) continue;
            if (!shown.at<std::uint8_t>(v, u) ||
                !shown_there.at<std::uint8_t>(int(std::lround(y)), int(std::lround(x))))
              continue;
            float sum = 0;
            for (int c = 0; c < 3; ++c)
              sum += std::abs(float(moved.at<cv::Vec3b>(v, u)[c]) -
                              float(reference.at<cv::Vec3b>(v, u)[c]));
            gaps[k].at<float>(v, u) = sum / 3;
          }
      },
      [](int) {});

  double total = 0;
  long pixels = 0;
  std::vector<float> at_pixel;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      at_pixel.clear();
      for (const cv::Mat& gap : gaps)
        if (const float value = gap.at<float>(v, u); std::isfinite(value))
          at_pixel.push_back(value);
      if (at_pixel.empty()) continue;
      const auto middle = at_pixel.begin() + std::ptrdiff_t(at_pixel.size() / 2);
      std::nth_element(at_pixel.begin(), middle, at_pixel.end());
      total += *middle;
      ++pixels;
    }
  return pixels > 0 ? total / double(pixels) : double(kNoEstimate);
}

}  // namespace gigaray::baselines
