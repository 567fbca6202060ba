// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <utility>

#include "gigaray/baselines/pair.h"
#include "gigaray/baselines/view_line.h"

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
  const auto same = std::ranges::unique(line, {}, distance);
  line.erase(same.begin(), same.end());
  std::vector<double> distances;
  for (const Neighbour& other : line) distances.push_back(double(distance(other)));
  std::vector<Neighbour> chosen;
  for (const int i : doubling(distances)) chosen.push_back(line[i]);
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

cv::Mat to_view(const cv::Mat& of_pair, const Neighbour& other, Direction direction) {
  cv::Mat disparity = of_pair / std::abs(other.steps);
  if (other.steps < 0) cv::flip(disparity, disparity, 1);
  if (direction == Direction::kColumn) cv::transpose(disparity, disparity);
  return disparity;
}

}  // namespace

std::vector<PairOfViews> pairs_in_line(const Problem& problem) {
  Direction direction = Direction::kRow;
  std::vector<Neighbour> line = views_along(problem, direction);
  if (line.size() < 2) {
    direction = Direction::kColumn;
    line = views_along(problem, direction);
  }
  std::vector<PairOfViews> pairs;
  for (const Neighbour& other : separations(line))
    pairs.push_back(
        {other.view, (problem.range.max - problem.range.min) * std::abs(other.steps),
         [=] { return pair_of(problem, other, direction); },
         [=](const cv::Mat& disparity) { return to_view(disparity, other, direction); }});
  return pairs;
}

}  // namespace gigaray::baselines
