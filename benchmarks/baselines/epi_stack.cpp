// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "baselines/epi_stack.h"

#include <algorithm>
#include <cmath>

#include "baselines/pictures.h"

namespace gigaray::baselines {
namespace {

constexpr double kMostParallax = 0.5;  ///< px, across the epipolar lines
constexpr double kUneven = 0.2;        ///< of a step

}  // namespace

std::vector<int> EpiStack::views_from_reference() const {
  std::vector<int> result = views;
  std::rotate(result.begin(), result.begin() + reference, result.begin() + reference + 1);
  return result;
}

std::vector<cv::Mat> EpiStack::pictures(const Problem& problem) const {
  std::vector<cv::Mat> result;
  for (const int view : views) {
    result.push_back(picture_of(problem.light_field, view));
    if (direction == Direction::kColumn) cv::transpose(result.back(), result.back());
  }
  return result;
}

std::optional<EpiStack> epi_stack(const Problem& problem, Direction direction, int most_each_side) {
  const LightField& light_field = problem.light_field;
  const bool is_row = direction == Direction::kRow;
  const auto along = [&](int view) {
    return is_row ? light_field.views[view].s : light_field.views[view].t;
  };
  const auto across = [&](int view) {
    return is_row ? light_field.views[view].t : light_field.views[view].s;
  };
  const double most = std::max({std::abs(problem.range.min), std::abs(problem.range.max), 1e-6});
  EpiStack stack;
  stack.direction = direction;
  for (int view = 0; view < light_field.num_views(); ++view)
    if (std::abs(across(view) - across(problem.view)) * most < kMostParallax)
      stack.views.push_back(view);
  std::ranges::sort(stack.views, {}, along);
  const auto reference = std::ranges::find(stack.views, problem.view);
  const auto end = stack.views.end() - reference > most_each_side + 1
                       ? reference + most_each_side + 1
                       : stack.views.end();
  const auto begin = reference - stack.views.begin() > most_each_side ? reference - most_each_side
                                                                      : stack.views.begin();
  stack.views = std::vector<int>(begin, end);
  if (stack.views.size() < 3) return {};
  for (const int view : stack.views) {
    if (view == problem.view) stack.reference = int(stack.steps.size());
    stack.steps.push_back(along(view) - along(problem.view));
  }
  const double step = (stack.steps.back() - stack.steps.front()) / double(stack.steps.size() - 1);
  for (std::size_t i = 1; i < stack.steps.size(); ++i)
    if (std::abs(stack.steps[i] - stack.steps[i - 1] - step) > kUneven * step) return {};
  return stack;
}

}  // namespace gigaray::baselines
