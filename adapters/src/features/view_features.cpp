// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "features/view_features.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace gigaray {

ViewFeatures features_of(const LightField& light_field, int view, int largest) {
  const Image<std::uint16_t> picture = read_view(light_field, view);
  const bool is_masked = picture.channels() > 3;
  cv::Mat grey(picture.height(), picture.width(), CV_8UC1);
  cv::Mat shown(is_masked ? grey.size() : cv::Size(), CV_8UC1);
  const int shift = light_field.pixels->bit_depth() - 8;
  for (int v = 0; v < grey.rows; ++v)
    for (int u = 0; u < grey.cols; ++u) {
      grey.at<std::uint8_t>(v, u) =
          std::uint8_t(((picture(u, v, 0) + 2 * picture(u, v, 1) + picture(u, v, 2)) / 4) >> shift);
      if (is_masked) shown.at<std::uint8_t>(v, u) = picture(u, v, 3) != 0 ? 255 : 0;
    }
  ViewFeatures features;
  features.scale = std::min(1.0, double(largest) / std::max(grey.cols, grey.rows));
  if (features.scale < 1) {
    cv::resize(grey, grey, {}, features.scale, features.scale, cv::INTER_AREA);
    if (is_masked) cv::resize(shown, shown, grey.size(), 0, 0, cv::INTER_NEAREST);
  }
  const double full_u = double(picture.width()) / grey.cols;
  const double full_v = double(picture.height()) / grey.rows;
  constexpr int kMostFeatures = 3000;
  std::vector<cv::KeyPoint> points;
  cv::SIFT::create(kMostFeatures)->detectAndCompute(grey, shown, points, features.descriptors);
  // A reduced pixel covers several: their outer edges agree, not their centres.
  for (const cv::KeyPoint& point : points)
    features.places.emplace_back(float((point.pt.x + 0.5) * full_u - 0.5),
                                 float((point.pt.y + 0.5) * full_v - 0.5));
  return features;
}

std::vector<FeatureMatch> matches_of(const ViewFeatures& a, const ViewFeatures& b) {
  constexpr float kClearlyBest = 0.75f;
  if (a.places.size() < 2 || b.places.size() < 2) return {};
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_L2).knnMatch(a.descriptors, b.descriptors, found, 2);
  std::vector<FeatureMatch> matches;
  std::vector<cv::Point2f> from, to;
  for (const auto& match : found) {
    if (match.size() < 2 || match[0].distance > kClearlyBest * match[1].distance) continue;
    matches.push_back(
        {a.places[std::size_t(match[0].queryIdx)], b.places[std::size_t(match[0].trainIdx)]});
    from.push_back(matches.back().a);
    to.push_back(matches.back().b);
  }
  if (matches.size() < kLeastMatches) return {};
  cv::Mat is_right;
  cv::findFundamentalMat(from, to, cv::FM_RANSAC, 1.0 / std::min(a.scale, b.scale), 0.99, is_right);
  if (is_right.total() != matches.size()) return {};
  std::vector<FeatureMatch> kept;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (is_right.at<std::uint8_t>(int(i))) kept.push_back(matches[i]);
  return kept.size() < kLeastMatches ? std::vector<FeatureMatch>() : kept;
}

}  // namespace gigaray
