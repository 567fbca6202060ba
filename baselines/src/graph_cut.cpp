// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Graph cuts in the style of Kolmogorov and Zabih 2001.
#include <opencv2/imgproc.hpp>

#include "gigaray/baselines/labelling.h"
#include "gigaray/baselines/methods.h"
#include "gigaray/core/parallel.h"

namespace gigaray::baselines {
namespace {

// Grey levels of 255.
constexpr float kMostCost = 20, kWeight = 8, kWeightOnEdges = 2.5;
constexpr int kEdge = 8;
constexpr int kMostStep = 2, kRounds = 2;        // px
constexpr int kMostLabels = 80, kMostParts = 4;  // of a pixel

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

Smoothness smoothness_of(const cv::Mat& picture, int parts) {
  Smoothness smoothness{cv::Mat(picture.size(), CV_32F), cv::Mat(picture.size(), CV_32F),
                        kMostStep * parts};
  const auto weight = [&](cv::Vec3b a, cv::Vec3b b) {
    const int gap = (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 3;
    return (gap < kEdge ? kWeight : kWeightOnEdges) / float(parts);
  };
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u) {
      const auto at = [&](int x, int y) { return picture.at<cv::Vec3b>(y, x); };
      smoothness.right.at<float>(v, u) = weight(at(u, v), at(std::min(u + 1, picture.cols - 1), v));
      smoothness.down.at<float>(v, u) = weight(at(u, v), at(u, std::min(v + 1, picture.rows - 1)));
    }
  return smoothness;
}

/// The picture with everything `shift` px farther to the right.
cv::Mat shifted(const cv::Mat& picture, double shift) {
  const cv::Mat way = (cv::Mat_<double>(2, 3) << 1, 0, shift, 0, 1, 0);
  cv::Mat result;
  cv::warpAffine(picture, result, way, picture.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

cv::Mat labelled(const Pair& pair, const RunControl& control) {
  // Parts of a pixel as far as the number of labels allows.
  int parts = 1;
  while (2 * parts <= kMostParts && 2 * parts * pair.labels() <= kMostLabels) parts *= 2;
  const Interval reference = interval_of(pair.reference);
  Volume volume(std::size_t(pair.labels() - 1) * parts + 1);
  for (int part = 0; part < parts; ++part) {
    const Interval other = interval_of(shifted(pair.other, double(part) / parts));
    control.throw_if_cancelled();
    for (std::size_t label = part; label < volume.size(); label += parts)
      volume[label] = cost_of(reference, other, pair.least + int(label) / parts);
  }
  const cv::Mat start(pair.reference.size(), CV_32S, cv::Scalar(int(volume.size()) / 2));
  const cv::Mat labels =
      expanded(start, volume, smoothness_of(pair.reference, parts), kRounds, control);
  cv::Mat disparity;
  labels.convertTo(disparity, CV_32F, 1.0 / parts, pair.least);
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
      "graph_cut", "Graph cuts",
      "after Kolmogorov and Zabih 2001, by alpha expansion (Boykov et al. 2001) without their "
      "uniqueness term; OpenCV's max-flow",
      "alpha expansion, 2 rounds; colours compared as Birchfield and Tomasi 1998, at most 20 of "
      "255; neighbours pay 8 (2.5 where colours differ by 8 or more) per px, at most 2 px; up to "
      "80 labels, quarters, halves or whole px as they allow; both sides agree within 1 px, else "
      "from the farther neighbour",
      [](const Problem& problem) { return pair_trials(problem, match, kMostLabels); }};
}

}  // namespace gigaray::baselines
