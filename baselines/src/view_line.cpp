// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/view_line.h"

#include <algorithm>
#include <cmath>

#include "gigaray/baselines/pictures.h"

namespace gigaray::baselines {
namespace {

constexpr double kMostOff = 0.25;      ///< view steps across
constexpr double kMostParallax = 0.5;  ///< px across
constexpr double kLeastStep = 0.5;     ///< nearer ones are the same place

}  // namespace

std::vector<Neighbour> views_along(const Problem& problem, Direction direction) {
  if (problem.light_field.kind == LightFieldKind::kUnstructured) return {};
  const std::vector<View>& views = problem.light_field.views;
  const bool is_row = direction == Direction::kRow;
  const View& middle = views[problem.view];
  const double most = std::max(std::abs(problem.range.min), std::abs(problem.range.max));
  struct Candidate {
    Neighbour neighbour;
    double off;
  };
  std::vector<Candidate> candidates;
  for (int i = 0; i < int(views.size()); ++i) {
    const double ds = views[i].s - middle.s, dt = views[i].t - middle.t;
    const double off = std::abs(is_row ? dt : ds);
    if (off < kMostOff && off * most < kMostParallax)
      candidates.push_back({{i, is_row ? ds : dt}, off});
  }
  // Those that are least off have the first choice of places; the view itself is off by nothing.
  std::ranges::stable_sort(candidates, {}, [&](const Candidate& candidate) {
    return candidate.neighbour.view == problem.view ? -1 : candidate.off;
  });
  std::vector<Neighbour> line;
  for (const Candidate& candidate : candidates)
    if (std::ranges::none_of(line, [&](const Neighbour& taken) {
          return std::abs(taken.steps - candidate.neighbour.steps) < kLeastStep;
        }))
      line.push_back(candidate.neighbour);
  std::ranges::sort(line, {}, &Neighbour::steps);
  return line;
}

cv::Mat picture_along(const Problem& problem, int view, Direction direction) {
  cv::Mat picture = picture_of(problem.light_field, view);
  if (direction == Direction::kColumn) cv::transpose(picture, picture);
  return picture;
}

}  // namespace gigaray::baselines
