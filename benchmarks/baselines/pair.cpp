// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "baselines/pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "baselines/pictures.h"
#include "baselines/view_line.h"

namespace gigaray::baselines {
namespace {

/// Other views: the nearest to 1, 2, 4 … steps and the farthest, rising; of equally far ones that
/// with the larger s.
std::vector<Neighbour> separations(std::vector<Neighbour> line) {
  std::erase_if(line, [](const Neighbour& other) { return other.steps == 0; });
  // In quarters of a step, so that positions may be a little off.
  const auto distance = [](const Neighbour& other) {
    return std::lround(4 * std::abs(other.steps));
  };
  std::ranges::sort(line, [&](const Neighbour& a, const Neighbour& b) {
    return std::pair(distance(a), -a.steps) < std::pair(distance(b), -b.steps);
  });
  std::vector<Neighbour> chosen;
  long next = 0;
  for (const Neighbour& other : line) {
    const bool is_farthest = distance(other) == distance(line.back());
    if (distance(other) < next && !is_farthest) continue;
    if (!chosen.empty() && distance(chosen.back()) == distance(other)) continue;
    chosen.push_back(other);
    next = std::lround(1.9 * double(distance(other)));
  }
  return chosen;
}

Pair pair_of(const Problem& problem, const Neighbour& other, Direction direction) {
  Pair pair;
  pair.reference = picture_along(problem, problem.view, direction);
  pair.other = picture_along(problem, other.view, direction);
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
  Direction direction = Direction::kRow;
  std::vector<Neighbour> line = views_along(problem, direction);
  if (line.size() < 2) {
    direction = Direction::kColumn;
    line = views_along(problem, direction);
  }
  std::vector<Trial> trials;
  for (const Neighbour& other : separations(line)) {
    if ((problem.range.max - problem.range.min) * std::abs(other.steps) + 3 > most_labels) continue;
    const auto run = [problem, other, direction, match](const RunControl& control) {
      const Pair pair = pair_of(problem, other, direction);
      cv::Mat disparity = match(pair, control);
      // Some look farther than they were asked to.
      disparity.setTo(kNoEstimate, disparity < pair.least);
      disparity.setTo(kNoEstimate, disparity > pair.most);
      fill_from_farther(disparity);
      disparity /= std::abs(other.steps);
      if (other.steps < 0) cv::flip(disparity, disparity, 1);
      if (direction == Direction::kColumn) cv::transpose(disparity, disparity);
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
