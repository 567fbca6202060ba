// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Graph cuts in the style of Kolmogorov and Zabih 2001.
#include <opencv2/imgproc.hpp>

#include "baselines/labelling.h"
#include "baselines/methods.h"
#include "gigaray/parallel.h"

namespace gigaray::baselines {
namespace {

// Grey levels of 255.
constexpr float kMostCost = 20, kWeight = 8, kWeightOnEdges = 2.5;
constexpr int kEdge = 8;
constexpr int kMostStep = 2, kRounds = 2;

/// Least and largest value between a pixel's colour and those half way to its neighbours
/// (Birchfield and Tomasi 1998).
struct Interval {
  cv::Mat value, least, most;  ///< CV_32FC3
};

Interval interval_of(const cv::Mat& picture) {
  Interval result;
  picture.convertTo(result.value, CV_32F);
  cv::Mat left, right;
  const cv::Mat before = (cv::Mat_<float>(1, 3) << 0.5, 0.5, 0),
                after = (cv::Mat_<float>(1, 3) << 0, 0.5, 0.5);
  cv::filter2D(result.value, left, -1, before, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::filter2D(result.value, right, -1, after, {-1, -1}, 0, cv::BORDER_REPLICATE);
  result.least = cv::min(result.value, cv::min(left, right));
  result.most = cv::max(result.value, cv::max(left, right));
  return result;
}

float beyond(float value, float least, float most) {
  return std::max({0.0f, value - most, least - value});
}

cv::Mat cost_of(const Interval& reference, const Interval& other, int disparity) {
  cv::Mat cost(reference.value.size(), CV_32F, kMostCost);
  for (int v = 0; v < cost.rows; ++v)
    for (int u = std::max(0, disparity); u < std::min(cost.cols, cost.cols + disparity); ++u) {
      const auto at = [&](const cv::Mat& map, int column) { return map.at<cv::Vec3f>(v, column); };
      const int there = u - disparity;
      float sum = 0;
      for (int c = 0; c < 3; ++c)
        sum += std::min(
            beyond(at(reference.value, u)[c], at(other.least, there)[c], at(other.most, there)[c]),
            beyond(at(other.value, there)[c], at(reference.least, u)[c], at(reference.most, u)[c]));
      cost.at<float>(v, u) = std::min(kMostCost, sum / 3);
    }
  return cost;
}

Smoothness smoothness_of(const cv::Mat& picture) {
  Smoothness smoothness{cv::Mat(picture.size(), CV_32F), cv::Mat(picture.size(), CV_32F),
                        kMostStep};
  const auto weight = [&](cv::Vec3b a, cv::Vec3b b) {
    const int gap = (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 3;
    return gap < kEdge ? kWeight : kWeightOnEdges;
  };
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u) {
      const auto at = [&](int x, int y) { return picture.at<cv::Vec3b>(y, x); };
      smoothness.right.at<float>(v, u) = weight(at(u, v), at(std::min(u + 1, picture.cols - 1), v));
      smoothness.down.at<float>(v, u) = weight(at(u, v), at(u, std::min(v + 1, picture.rows - 1)));
    }
  return smoothness;
}

cv::Mat labelled(const Pair& pair, const RunControl& control) {
  const Interval reference = interval_of(pair.reference), other = interval_of(pair.other);
  Volume volume;
  for (int d = pair.least; d <= pair.most; ++d) volume.push_back(cost_of(reference, other, d));
  const cv::Mat start(pair.reference.size(), CV_32S, cv::Scalar(pair.labels() / 2));
  const cv::Mat labels = expanded(start, volume, smoothness_of(pair.reference), kRounds, control);
  cv::Mat disparity(labels.size(), CV_32F);
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u)
      disparity.at<float>(v, u) = float(pair.least + labels.at<int>(v, u));
  return disparity;
}

cv::Mat match(const Pair& pair, const RunControl& control) {
  cv::Mat sides[2];
  parallel_for(
      2, [&](int side) { sides[side] = labelled(side == 0 ? pair : pair.turned(), control); },
      [](int) {});
  return agreed(sides[0], sides[1], 1);
}

}  // namespace

Baseline graph_cut() {
  return {
      "graph_cut", "Graph cuts", "Kolmogorov and Zabih 2001, Boykov et al. 2001; OpenCV's max-flow",
      "alpha expansion, 2 rounds; colours compared as Birchfield and Tomasi 1998, at most 20 of "
      "255; neighbours pay 8 (2.5 where colours differ by 8 or more) per step, at most 2 steps; "
      "whole px; both sides agree within 1 px, else from the farther neighbour; up to 80 labels",
      [](const Problem& problem) { return pair_trials(problem, match, 80); }};
}

}  // namespace gigaray::baselines
