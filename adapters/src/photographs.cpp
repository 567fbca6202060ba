// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/photographs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

namespace gigaray {
namespace {

constexpr int kLargest = 1000;  // px
constexpr std::size_t kLeastMatches = 30;

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

Features features_of(const LightField& light_field, int view) {
  const Image<std::uint16_t> picture = read_view(light_field, view);
  cv::Mat grey(picture.height(), picture.width(), CV_8UC1);
  const int shift = light_field.pixels->bit_depth() - 8;
  for (int v = 0; v < grey.rows; ++v)
    for (int u = 0; u < grey.cols; ++u)
      grey.at<std::uint8_t>(v, u) =
          std::uint8_t(((picture(u, v, 0) + 2 * picture(u, v, 1) + picture(u, v, 2)) / 4) >> shift);
  const double scale = double(kLargest) / std::max(grey.cols, grey.rows);
  if (scale < 1) cv::resize(grey, grey, {}, scale, scale, cv::INTER_AREA);
  Features features;
  constexpr int kMostFeatures = 3000;
  cv::SIFT::create(kMostFeatures)
      ->detectAndCompute(grey, {}, features.points, features.descriptors);
  return features;
}

/// Displacements of features from a to b that agree with two pinhole views of a still scene.
std::vector<cv::Point2f> displacements(const Features& a, const Features& b) {
  constexpr float kClearlyBest = 0.75f;
  std::vector<cv::Point2f> from, to;
  if (a.points.size() < 2 || b.points.size() < 2) return {};
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_L2).knnMatch(a.descriptors, b.descriptors, matches, 2);
  for (const auto& match : matches) {
    if (match.size() < 2 || match[0].distance > kClearlyBest * match[1].distance) continue;
    from.push_back(a.points[match[0].queryIdx].pt);
    to.push_back(b.points[match[0].trainIdx].pt);
  }
  if (from.size() < kLeastMatches) return {};
  cv::Mat is_right;
  cv::findFundamentalMat(from, to, cv::FM_RANSAC, 1.0, 0.99, is_right);
  std::vector<cv::Point2f> moved;
  for (int i = 0; i < is_right.rows; ++i)
    if (is_right.at<std::uint8_t>(i)) moved.push_back(to[i] - from[i]);
  return moved;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::optional<double> displacement_across_rows(const LightField& light_field,
                                               const RunControl& control) {
  std::vector<int> order(light_field.views.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return light_field.views[a].s < light_field.views[b].s; });
  const int count = int(order.size());
  std::set<int> firsts;
  for (const double at : {0.2, 0.5, 0.8}) firsts.insert(int(at * (count - 1)));
  std::vector<double> across;
  for (const int first : firsts) {
    if (first + 1 >= count) continue;
    control.progress("rows", double(across.size()), double(firsts.size()));
    control.throw_if_cancelled();
    const auto moved = displacements(features_of(light_field, order[first]),
                                     features_of(light_field, order[first + 1]));
    if (moved.size() < kLeastMatches) continue;
    std::vector<double> du, dv;
    for (const cv::Point2f& d : moved) {
      du.push_back(std::abs(d.x));
      dv.push_back(std::abs(d.y));
    }
    across.push_back(std::min(median(du), median(dv)));
  }
  if (across.empty()) return std::nullopt;
  return *std::max_element(across.begin(), across.end());
}

}  // namespace gigaray
