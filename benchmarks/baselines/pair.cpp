// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "baselines/pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "baselines/pictures.h"

namespace gigaray::baselines {
namespace {

/// Rows that are off by less than half a pixel count as the same.
constexpr double kMostParallax = 0.5;

struct Separation {
  int view;
  double steps;  ///< signed, along s
};

/// Other views in the row of the problem's view: the nearest to 1, 2, 4 … steps and the farthest,
/// rising.
std::vector<Separation> separations(const Problem& problem) {
  const std::vector<View>& views = problem.light_field.views;
  const View& reference = views[problem.view];
  const double most = std::max({std::abs(problem.range.min), std::abs(problem.range.max), 1e-6});
  std::vector<Separation> row;
  for (int i = 0; i < int(views.size()); ++i)
    if (i != problem.view && std::abs(views[i].t - reference.t) * most < kMostParallax)
      row.push_back({i, views[i].s - reference.s});
  // Of equally far ones that to the right.
  std::ranges::sort(row, [](const Separation& a, const Separation& b) {
    const double difference = std::abs(a.steps) - std::abs(b.steps);
    return std::abs(difference) > 1e-3 ? difference < 0 : a.steps > b.steps;
  });
  std::vector<Separation> chosen;
  double next = 0.5;
  for (const Separation& other : row)
    if (std::abs(other.steps) >= next) {
      chosen.push_back(other);
      next = 1.9 * std::abs(other.steps);
    }
  if (!row.empty()) {
    const auto far = std::ranges::find_if(row, [&](const Separation& other) {
      return std::abs(std::abs(other.steps) - std::abs(row.back().steps)) <= 1e-3;
    });
    if (chosen.empty() || std::abs(chosen.back().steps) < std::abs(far->steps) - 1e-3)
      chosen.push_back(*far);
  }
  return chosen;
}

Pair pair_of(const Problem& problem, const Separation& other) {
  Pair pair;
  pair.reference = picture_of(problem.light_field, problem.view);
  pair.other = picture_of(problem.light_field, other.view);
  if (other.steps < 0) {
    cv::flip(pair.reference, pair.reference, 1);
    cv::flip(pair.other, pair.other, 1);
  }
  const double steps = std::abs(other.steps);
  pair.least = int(std::floor(problem.range.min * steps)) - 1;
  pair.most = int(std::ceil(problem.range.max * steps)) + 1;
  return pair;
}

}  // namespace

Pair Pair::turned() const {
  Pair pair{{}, {}, least, most};
  cv::flip(other, pair.reference, 1);
  cv::flip(reference, pair.other, 1);
  return pair;
}

std::vector<Trial> pair_trials(const Problem& problem, const Match& match, int most_labels) {
  std::vector<Trial> trials;
  for (const Separation& other : separations(problem)) {
    if ((problem.range.max - problem.range.min) * std::abs(other.steps) + 3 > most_labels) continue;
    const auto run = [problem, other, match](const RunControl& control) {
      const Pair pair = pair_of(problem, other);
      cv::Mat disparity = match(pair, control);
      fill_from_farther(disparity);
      disparity /= std::abs(other.steps);
      if (other.steps < 0) cv::flip(disparity, disparity, 1);
      return Estimate{map_of(disparity), {problem.view, other.view}};
    };
    trials.push_back({fmt::format("views {} and {}", problem.light_field.views[problem.view].name,
                                  problem.light_field.views[other.view].name),
                      run});
  }
  return trials;
}

cv::Mat agreed(const cv::Mat& disparity, const cv::Mat& of_turned, float tolerance) {
  cv::Mat result = disparity.clone();
  for (int v = 0; v < result.rows; ++v)
    for (int u = 0; u < result.cols; ++u) {
      float& d = result.at<float>(v, u);
      const int there = int(std::lround(float(u) - (std::isfinite(d) ? d : 0)));
      const bool is_seen = there >= 0 && there < result.cols;
      const float other = is_seen ? of_turned.at<float>(v, result.cols - 1 - there) : kNoEstimate;
      if (!(std::abs(d - other) <= tolerance)) d = kNoEstimate;
    }
  return result;
}

void fill_from_farther(cv::Mat& disparity) {
  for (int v = 0; v < disparity.rows; ++v) {
    float* row = disparity.ptr<float>(v);
    float left = kNoEstimate;
    for (int u = 0; u < disparity.cols;) {
      if (std::isfinite(row[u])) {
        left = row[u++];
        continue;
      }
      int end = u;
      while (end < disparity.cols && !std::isfinite(row[end])) ++end;
      const float right = end < disparity.cols ? row[end] : kNoEstimate;
      std::fill(row + u, row + end, std::fmin(left, right));
      u = end;
    }
  }
}

cv::Mat least_cost(const Volume& volume) {
  const int labels = int(volume.size());
  cv::Mat result(volume.front().size(), CV_32F);
  for (int v = 0; v < result.rows; ++v)
    for (int u = 0; u < result.cols; ++u) {
      const auto cost = [&](int label) { return volume[label].at<float>(v, u); };
      int best = 0;
      for (int label = 1; label < labels; ++label)
        if (cost(label) < cost(best)) best = label;
      float value = float(best);
      if (best > 0 && best + 1 < labels)
        value += parabola(cost(best - 1), cost(best), cost(best + 1));
      result.at<float>(v, u) = value;
    }
  return result;
}

}  // namespace gigaray::baselines
