// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/epi_stack.h"

#include <algorithm>
#include <cmath>

namespace gigaray::baselines {
namespace {

constexpr double kUneven = 0.2;  ///< of a step

}  // namespace

double EpiStack::step() const {
  return (views.back().steps - views.front().steps) / double(size() - 1);
}

std::vector<int> EpiStack::views_from_reference() const {
  std::vector<int> result;
  for (const Neighbour& other : views) result.push_back(other.view);
  std::rotate(result.begin(), result.begin() + reference, result.begin() + reference + 1);
  return result;
}

std::vector<cv::Mat> EpiStack::pictures(const Problem& problem) const {
  std::vector<cv::Mat> result;
  for (const Neighbour& other : views)
    result.push_back(picture_along(problem, other.view, direction));
  return result;
}

std::optional<EpiStack> epi_stack(const Problem& problem, Direction direction, int most_each_side) {
  const std::vector<Neighbour> line = views_along(problem, direction);
  const int reference = int(std::ranges::find(line, problem.view, &Neighbour::view) - line.begin());
  const int begin = std::max(0, reference - most_each_side),
            end = std::min(int(line.size()), reference + most_each_side + 1);
  EpiStack stack{direction, {line.begin() + begin, line.begin() + end}, reference - begin};
  if (stack.size() < 3) return {};
  const double step = stack.step();
  for (int i = 1; i < stack.size(); ++i)
    if (std::abs(stack.views[i].steps - stack.views[i - 1].steps - step) > kUneven * step)
      return {};
  return stack;
}

}  // namespace gigaray::baselines
