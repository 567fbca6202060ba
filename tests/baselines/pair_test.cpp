// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "gigaray/baselines/labelling.h"

namespace gigaray::baselines {
namespace {

cv::Mat row_of(std::vector<float> values) { return cv::Mat(values, true).reshape(1, 1); }

std::vector<float> values_of(const cv::Mat& row) { return row.reshape(1, 1); }

TEST(Pair, TurnedSwapsAndMirrors) {
  Pair pair{cv::Mat(1, 4, CV_8UC3), cv::Mat(1, 4, CV_8UC3), 1, 2};
  for (int u = 0; u < 4; ++u) {
    pair.reference.at<cv::Vec3b>(0, u) = cv::Vec3b::all(uchar(u));
    pair.other.at<cv::Vec3b>(0, u) = cv::Vec3b::all(uchar(10 + u));
  }
  const Pair turned = pair.turned();
  EXPECT_EQ(turned.reference.at<cv::Vec3b>(0, 0)[0], 13);
  EXPECT_EQ(turned.other.at<cv::Vec3b>(0, 3)[0], 0);
  EXPECT_EQ(turned.least, 1);
}

TEST(Pair, AgreedDropsWhatTheOtherSideDenies) {
  // The reference sees at u = 2 with disparity 1 what the other shows at 1, which is 3 - 1 = 2 of
  // the mirrored one.
  const cv::Mat reference = row_of({0, 0, 1, 1}), turned = row_of({0, 1, 1, 0});
  const std::vector<float> result = values_of(agreed(reference, turned, 0.5f));
  EXPECT_EQ(result[0], 0);
  EXPECT_TRUE(std::isnan(result[1]));
  EXPECT_EQ(result[2], 1);
  EXPECT_EQ(result[3], 1);
}

TEST(Pair, HolesTakeTheFartherNeighbour) {
  const float hole = kNoEstimate;
  cv::Mat row = row_of({hole, 3, hole, hole, 1, hole});
  fill_from_farther(row);
  EXPECT_EQ(values_of(row), (std::vector<float>{3, 3, 1, 1, 1, 1}));
  cv::Mat nothing = row_of({hole, hole});
  fill_from_farther(nothing);
  EXPECT_TRUE(std::isnan(nothing.at<float>(0)));
}

TEST(Pair, EmptyRowsTakeTheNearestOne) {
  cv::Mat map(4, 1, CV_32F, cv::Scalar(kNoEstimate));
  map.at<float>(1) = 2;
  map.at<float>(3) = 7;
  fill_from_farther(map);
  EXPECT_EQ(values_of(map.t()), (std::vector<float>{2, 2, 2, 7}));
}

TEST(Pair, TheParabolaFindsTheBottomBetweenLabels) {
  const auto cost = [](float x) { return (x - 0.3f) * (x - 0.3f); };
  EXPECT_NEAR(parabola(cost(-1), cost(0), cost(1)), 0.3f, 1e-6);
  EXPECT_EQ(parabola(1, 1, 1), 0);
}

class Labelling : public testing::Test {
 protected:
  static constexpr int kWidth = 4, kHeight = 3;

  Labelling() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto noise = [&] {
      cv::Mat map(kHeight, kWidth, CV_32F);
      for (float& value : cv::Mat_<float>(map)) value = uniform(random);
      return map;
    };
    for (int label = 0; label < 3; ++label) costs.push_back(noise());
    smoothness = {noise() * 0.4, noise() * 0.4, 2};
  }

  double energy(const cv::Mat& labels) const {
    double sum = 0;
    const auto step = [&](int a, int b) {
      return double(std::min(std::abs(a - b), smoothness.most_step));
    };
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const int label = labels.at<int>(v, u);
        sum += costs[label].at<float>(v, u);
        if (u + 1 < kWidth)
          sum += smoothness.right.at<float>(v, u) * step(label, labels.at<int>(v, u + 1));
        if (v + 1 < kHeight)
          sum += smoothness.down.at<float>(v, u) * step(label, labels.at<int>(v + 1, u));
      }
    return sum;
  }

  /// The least energy of all labellings with so many labels.
  double least_energy(int labels) const {
    double least = 1e9;
    cv::Mat map(kHeight, kWidth, CV_32S);
    const int all = int(std::lround(std::pow(labels, kWidth * kHeight)));
    for (int code = 0; code < all; ++code) {
      int rest = code;
      for (int i = 0; i < kWidth * kHeight; ++i, rest /= labels) map.ptr<int>()[i] = rest % labels;
      least = std::min(least, energy(map));
    }
    return least;
  }

  Volume costs;
  Smoothness smoothness;
};

TEST_F(Labelling, OfTwoLabelsIsTheBest) {
  costs.pop_back();
  const cv::Mat start = cv::Mat::zeros(kHeight, kWidth, CV_32S);
  EXPECT_NEAR(energy(expanded(start.clone(), costs, smoothness, 3, {})), least_energy(2), 1e-5);
}

TEST_F(Labelling, OfThreeIsNearlyTheBest) {
  const cv::Mat start = cv::Mat::zeros(kHeight, kWidth, CV_32S);
  const double found = energy(expanded(start.clone(), costs, smoothness, 5, {}));
  EXPECT_LE(found, 1.05 * least_energy(3));
  EXPECT_LT(found, energy(start));
}

TEST_F(Labelling, StopsWhenCancelled) {
  RunControl control;
  control.cancel();
  EXPECT_THROW(expanded(cv::Mat::zeros(kHeight, kWidth, CV_32S), costs, smoothness, 1, control),
               Error);
}

}  // namespace
}  // namespace gigaray::baselines
