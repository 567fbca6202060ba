// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Lines fitted to the edges of epipolar-plane images (Bolles et al. 1987).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "gigaray/baselines/epi_stack.h"
#include "gigaray/baselines/methods.h"
#include "gigaray/baselines/pictures.h"
#include "gigaray/core/parallel.h"

namespace gigaray::baselines {
namespace {

constexpr double kSigma = 1;         ///< px
constexpr float kLeastGradient = 2;  ///< grey levels per px
constexpr double kTolerance = 0.7;   ///< px from the line to the next view's edge
constexpr double kLeastShare = 0.6;  ///< of the views must have the edge
constexpr int kEachSide = 10;        ///< views

struct Edge {
  double u;
  float gradient;  ///< signed
};

/// Extremes of the gradient in a row, from left to right.
std::vector<Edge> edges_of(const cv::Mat& gradient, int v) {
  const float* row = gradient.ptr<float>(v);
  std::vector<Edge> edges;
  for (int u = 1; u + 1 < gradient.cols; ++u) {
    const float before = std::abs(row[u - 1]), here = std::abs(row[u]),
                after = std::abs(row[u + 1]);
    if (here < kLeastGradient || here < before || here <= after) continue;
    edges.push_back({u + double(parabola(-before, -here, -after)), row[u]});
  }
  return edges;
}

/// Do edges rise or fall about as much?
bool is_alike(float gradient, float other) {
  return gradient / other > 0.5f && gradient / other < 2;
}

/// The edge nearest to a place that rises or falls as much, or nothing.
const Edge* nearest(const std::vector<Edge>& edges, double u, float gradient) {
  const Edge* best = nullptr;
  const auto begin = std::ranges::lower_bound(edges, u - kTolerance, {}, &Edge::u);
  for (auto edge = begin; edge != edges.end() && edge->u <= u + kTolerance; ++edge) {
    if (!is_alike(edge->gradient, gradient)) continue;
    if (!best || std::abs(edge->u - u) < std::abs(best->u - u)) best = &*edge;
  }
  return best;
}

/// Least squares through points (step, u).
class Line {
 public:
  void add(double step, double u) {
    ++count_, s_ += step, u_ += u, ss_ += step * step, su_ += step * u, uu_ += u * u;
  }
  int count() const { return count_; }
  double slope() const { return (su_ - s_ * u_ / count_) / (ss_ - s_ * s_ / count_); }
  double at(double step) const { return u_ / count_ + slope() * (step - s_ / count_); }
  double residual() const {
    const double across = uu_ - u_ * u_ / count_, along = ss_ - s_ * s_ / count_;
    return std::max(0.0, across - slope() * slope() * along) / count_;
  }

 private:
  int count_ = 0;
  double s_ = 0, u_ = 0, ss_ = 0, su_ = 0, uu_ = 0;
};

/// From a first guess of the disparity outwards through all views, edge by edge.
Line followed(const EpiStack& stack, const std::vector<std::vector<Edge>>& edges, const Edge& from,
              int second, const Edge& to) {
  Line line;
  line.add(0, from.u);
  line.add(stack.views[second].steps, to.u);
  for (int distance = 1; distance < stack.size(); ++distance)
    for (const int j : {stack.reference - distance, stack.reference + distance}) {
      if (j < 0 || j >= stack.size() || j == second) continue;
      if (const Edge* edge = nearest(edges[j], line.at(stack.views[j].steps), from.gradient))
        line.add(stack.views[j].steps, edge->u);
    }
  return line;
}

/// Disparity of an edge of the reference, if enough views have it.
double disparity_of(const EpiStack& stack, const std::vector<std::vector<Edge>>& edges,
                    const Edge& edge, DisparityRange range) {
  Line best;
  const int second = stack.reference + 1 < stack.size() ? stack.reference + 1 : stack.reference - 1;
  const double step = stack.views[second].steps;
  const double ends[] = {edge.u - step * range.min, edge.u - step * range.max};
  for (const Edge& to : edges[second]) {
    if (to.u < std::min(ends[0], ends[1]) || to.u > std::max(ends[0], ends[1])) continue;
    if (!is_alike(to.gradient, edge.gradient)) continue;
    const Line line = followed(stack, edges, edge, second, to);
    if (line.count() > best.count() ||
        (line.count() == best.count() && line.residual() < best.residual()))
      best = line;
  }
  const bool is_sure = best.count() >= std::max(3.0, kLeastShare * stack.size());
  const double disparity = is_sure ? -best.slope() : kNoEstimate;
  return disparity >= range.min && disparity <= range.max ? disparity : kNoEstimate;
}

/// Between lines disparity changes evenly.
void interpolate(float* row, int width, const std::vector<std::pair<double, double>>& known) {
  for (int u = 0; u < width; ++u) {
    const auto next = std::ranges::lower_bound(known, double(u), {},
                                               [](const auto& place) { return place.first; });
    if (known.empty()) continue;
    if (next == known.begin() || next == known.end()) {
      row[u] = float(next == known.end() ? known.back().second : next->second);
      continue;
    }
    const auto& [u0, d0] = *(next - 1);
    const auto& [u1, d1] = *next;
    row[u] = float(d0 + (d1 - d0) * (u - u0) / (u1 - u0));
  }
}

cv::Mat lines_of(const EpiStack& stack, const std::vector<cv::Mat>& pictures, DisparityRange range,
                 const RunControl& control) {
  std::vector<cv::Mat> gradients;
  for (const cv::Mat& picture : pictures) {
    cv::Mat grey, gradient;
    cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_32F);
    cv::GaussianBlur(grey, grey, {7, 1}, kSigma, 0, cv::BORDER_REPLICATE);
    cv::Sobel(grey, gradient, CV_32F, 1, 0, 1, 0.5);
    gradients.push_back(gradient);
  }
  cv::Mat disparity(gradients[0].size(), CV_32F, cv::Scalar(kNoEstimate));
  parallel_for(
      disparity.rows,
      [&](int v) {
        std::vector<std::vector<Edge>> edges;
        for (const cv::Mat& gradient : gradients) edges.push_back(edges_of(gradient, v));
        std::vector<std::pair<double, double>> known;
        for (const Edge& edge : edges[stack.reference])
          if (const double d = disparity_of(stack, edges, edge, range); std::isfinite(d))
            known.emplace_back(edge.u, d);
        interpolate(disparity.ptr<float>(v), disparity.cols, known);
      },
      [&](int) { control.throw_if_cancelled(); });
  return disparity;
}

std::vector<Trial> trials(const Problem& problem) {
  auto stack = epi_stack(problem, Direction::kRow, kEachSide);
  if (!stack) stack = epi_stack(problem, Direction::kColumn, kEachSide);
  if (!stack) return {};
  const auto run = [stack = *stack, problem](const RunControl& control) {
    cv::Mat disparity = lines_of(stack, stack.pictures(problem), problem.range, control);
    fill_from_farther(disparity);
    if (stack.direction == Direction::kColumn) cv::transpose(disparity, disparity);
    return Estimate{map_of(disparity), stack.views_from_reference()};
  };
  return {{fmt::format("{} views", stack->size()), run}};
}

}  // namespace

Baseline edge_lines() {
  return {"edge_lines", "Lines fitted to EPI edges", "Bolles et al. 1987",
          "edges: extremes of the gradient with σ 1, 2 grey levels per px or more; followed within "
          "0.7 px of the fitted line through up to 21 views of the row, 60 % of them must have it; "
          "between lines disparity changes evenly",
          trials};
}

}  // namespace gigaray::baselines
