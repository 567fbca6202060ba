// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Fast cost-volume filtering (Rhemann et al. 2011) with OpenCV's guided filter.
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc.hpp>

#include "gigaray/baselines/methods.h"

namespace gigaray::baselines {
namespace {

// As in the paper; colours in [0, 1].
constexpr float kGradientShare = 0.9f, kMostColour = 7 / 255.0f, kMostGradient = 2 / 255.0f;
constexpr int kRadius = 9;
constexpr double kEpsilon = 1e-4;
constexpr int kMedianRadius = 9;
constexpr double kMedianSigma = 0.1 * 255;

struct Side {
  cv::Mat colour, gradient;  ///< CV_32FC3 in [0, 1], CV_32F along u
};

Side side_of(const cv::Mat& picture) {
  Side side;
  cv::Mat grey;
  picture.convertTo(side.colour, CV_32F, 1 / 255.0);
  cv::cvtColor(side.colour, grey, cv::COLOR_RGB2GRAY);
  cv::Sobel(grey, side.gradient, CV_32F, 1, 0, 1, 0.5);
  return side;
}

cv::Mat cost_of(const Side& reference, const Side& other, int disparity) {
  cv::Mat cost(reference.gradient.size(), CV_32F);
  for (int v = 0; v < cost.rows; ++v)
    for (int u = 0; u < cost.cols; ++u) {
      const int there = u - disparity;
      float colour = kMostColour, gradient = kMostGradient;
      if (there >= 0 && there < cost.cols) {
        const cv::Vec3f gap =
            reference.colour.at<cv::Vec3f>(v, u) - other.colour.at<cv::Vec3f>(v, there);
        colour = std::min(colour, (std::abs(gap[0]) + std::abs(gap[1]) + std::abs(gap[2])) / 3);
        gradient = std::min(gradient, std::abs(reference.gradient.at<float>(v, u) -
                                               other.gradient.at<float>(v, there)));
      }
      cost.at<float>(v, u) = (1 - kGradientShare) * colour + kGradientShare * gradient;
    }
  return cost;
}

cv::Mat winners(const Pair& pair, const RunControl& control) {
  const Side reference = side_of(pair.reference), other = side_of(pair.other);
  const auto filter = cv::ximgproc::createGuidedFilter(reference.colour, kRadius, kEpsilon);
  Volume volume(pair.labels());
  for (int label = 0; label < pair.labels(); ++label) {
    control.throw_if_cancelled();
    filter->filter(cost_of(reference, other, pair.least + label), volume[label]);
  }
  return least_cost(volume) + pair.least;
}

cv::Mat match(const Pair& pair, const RunControl& control) {
  cv::Mat disparity = agreed(winners(pair, control), winners(pair.turned(), control), 1);
  const cv::Mat holes = disparity != disparity;
  fill_from_farther(disparity);
  cv::setRNGSeed(1);  // The weighted median clusters colours from a random start.
  // Filled pixels take a weighted median, so that they don't show as stripes.
  cv::Mat smooth;
  cv::ximgproc::weightedMedianFilter(pair.reference, disparity, smooth, kMedianRadius,
                                     kMedianSigma);
  smooth.copyTo(disparity, holes);
  return disparity;
}

}  // namespace

Baseline cost_volume() {
  return {"cost_volume", "Cost-volume filtering", "Rhemann et al. 2011; OpenCV's guided filter",
          "truncated colour 7/255 and gradient 2/255 with weights 0.1 and 0.9, guided filter with "
          "radius 9 and ε 10⁻⁴, both sides agree within 1 px, weighted median with radius 9 where "
          "they don't; parabola between labels, up to 256",
          [](const Problem& problem) { return pair_trials(problem, match, 256); }};
}

}  // namespace gigaray::baselines
