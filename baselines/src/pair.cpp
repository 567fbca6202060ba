// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gigaray/baselines/pictures.h"

namespace gigaray::baselines {

Pair Pair::turned() const {
  Pair pair{{}, {}, least, most};
  cv::flip(other, pair.reference, 1);
  cv::flip(reference, pair.other, 1);
  return pair;
}

std::vector<int> doubling(const std::vector<double>& distances) {
  constexpr double kTwice = 1.9;  // Positions may be a little off.
  std::vector<int> chosen;
  for (int i = 0; i < int(distances.size()); ++i)
    if (chosen.empty() || distances[i] >= kTwice * distances[chosen.back()] ||
        i + 1 == int(distances.size()))
      chosen.push_back(i);
  return chosen;
}

std::vector<Trial> pair_trials(const Problem& problem, const Match& match, int most_labels) {
  const LightField& light_field = problem.light_field;
  const bool is_posed = light_field.kind == LightFieldKind::kUnstructured;
  std::vector<Trial> trials;
  for (const PairOfViews& views : is_posed ? pairs_of_cameras(problem) : pairs_in_line(problem)) {
    if (views.labels + 3 > most_labels) continue;
    const auto run = [views, match, reference = problem.view](const RunControl& control) {
      const Pair pair = views.read();
      cv::Mat disparity = match(pair, control);
      // Some look farther than they were asked to.
      disparity.setTo(kNoEstimate, disparity < pair.least);
      disparity.setTo(kNoEstimate, disparity > pair.most);
      if (!pair.shown.empty()) disparity.setTo(kNoEstimate, pair.shown == 0);
      fill_from_farther(disparity);
      return Estimate{map_of(views.to_view(disparity)), {reference, views.other}};
    };
    trials.push_back({fmt::format("views {} and {}", light_field.views[problem.view].name,
                                  light_field.views[views.other].name),
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
  std::vector<int> empty_rows, rows;
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
    (std::isfinite(row[0]) ? rows : empty_rows).push_back(v);
  }
  if (rows.empty()) return;
  for (const int v : empty_rows) {
    const auto distance = [v](int other) { return std::abs(other - v); };
    disparity.row(*std::ranges::min_element(rows, {}, distance)).copyTo(disparity.row(v));
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
