// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Matching between support points, in the style of Geiger et al. 2010.
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "gigaray/baselines/methods.h"
#include "gigaray/core/parallel.h"

namespace gigaray::baselines {
namespace {

constexpr int kGrid = 5;                // px between candidates of support points
constexpr float kUnique = 0.85f;        // best cost against the second best
constexpr float kLeastTexture = 0.02f;  // of a window's largest sum of gradients
constexpr int kCell = 20;               // px: disparities of a cell's points may be taken in it
// Cost of a candidate: matching in units of kBeta, and how far it is from the triangle's plane.
constexpr float kBeta = 0.02f, kGamma = 3, kSigma = 1;
constexpr int kAround = 3;  // px around the plane that are tried

/// Gradients of 16 places around a pixel.
using Descriptor = std::array<std::int16_t, 16>;

struct Described {
  int width, height;
  std::vector<Descriptor> descriptors;
  std::vector<int> texture;
  const Descriptor& at(int u, int v) const { return descriptors[std::size_t(v) * width + u]; }
};

Described described(const cv::Mat& picture) {
  cv::Mat grey, du, dv;
  cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  cv::Sobel(grey, du, CV_16S, 1, 0);
  cv::Sobel(grey, dv, CV_16S, 0, 1);
  du /= 4, dv /= 4;
  Described result{grey.cols, grey.rows, {}, {}};
  const auto value = [](const cv::Mat& map, int u, int v) {
    return map.at<std::int16_t>(std::clamp(v, 0, map.rows - 1), std::clamp(u, 0, map.cols - 1));
  };
  constexpr int kPlacesU[11][2] = {{0, 0}, {-2, 0}, {2, 0}, {-1, -1}, {1, -1}, {-1, 1},
                                   {1, 1}, {0, -2}, {0, 2}, {-2, -2}, {2, 2}};
  constexpr int kPlacesV[5][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  for (int v = 0; v < grey.rows; ++v)
    for (int u = 0; u < grey.cols; ++u) {
      Descriptor descriptor;
      auto out = descriptor.begin();
      for (const auto& [x, y] : kPlacesU) *out++ = value(du, u + x, v + y);
      for (const auto& [x, y] : kPlacesV) *out++ = value(dv, u + x, v + y);
      int texture = 0;
      for (const std::int16_t gradient : descriptor) texture += std::abs(gradient);
      result.descriptors.push_back(descriptor);
      result.texture.push_back(texture);
    }
  return result;
}

int difference(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

/// Both pictures of a pair.
struct Sides {
  Described reference, other;
  int least, most;

  /// Sum over the four places around, which tells more than one; none outside.
  std::optional<int> robust_cost(int u, int v, int d) const {
    if (u - d < 2 || u - d >= other.width - 2) return {};
    int sum = 0;
    for (const int y : {-2, 2})
      for (const int x : {-2, 2})
        sum += difference(reference.at(u + x, v + y), other.at(u - d + x, v + y));
    return sum;
  }
  /// The disparity of a pixel of the reference if it stands out.
  std::optional<int> sure_match(int u, int v) const {
    int best = 0, least_cost = std::numeric_limits<int>::max(), second = least_cost;
    for (int d = least; d <= most; ++d)
      if (const auto cost = robust_cost(u, v, d); cost && *cost < least_cost)
        least_cost = *cost, best = d;
    for (int d = least; d <= most; ++d)
      if (const auto cost = robust_cost(u, v, d); cost && std::abs(d - best) > 1)
        second = std::min(second, *cost);
    if (second == std::numeric_limits<int>::max() || float(least_cost) > kUnique * float(second))
      return {};
    return best;
  }
};

struct Support {
  int u, v, d;
};

std::vector<Support> support_points(const Sides& sides, const Sides& turned,
                                    const RunControl& control) {
  const int width = sides.reference.width, height = sides.reference.height;
  const int most_texture = *std::ranges::max_element(sides.reference.texture);
  std::vector<std::vector<Support>> rows(height);
  parallel_for(
      height,
      [&](int v) {
        if (v < 2 || v >= height - 2 || v % kGrid != 0) return;
        for (int u = kGrid; u < width - 2; u += kGrid) {
          if (float(sides.reference.texture[std::size_t(v) * width + u]) <
              kLeastTexture * float(most_texture))
            continue;
          const auto d = sides.sure_match(u, v);
          if (!d) continue;
          const auto back = turned.sure_match(width - 1 - (u - *d), v);
          if (back && std::abs(*back - *d) <= 1) rows[v].push_back({u, v, *d});
        }
      },
      [&](int) { control.throw_if_cancelled(); });
  std::vector<Support> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  // Those that hardly another one near by agrees with are wrong.
  constexpr int kNone = std::numeric_limits<int>::max(), kReach = 5, kSame = 2, kLeastAgree = 2;
  cv::Mat at(height / kGrid + 1, width / kGrid + 1, CV_32S, cv::Scalar(kNone));
  for (const Support& point : all) at.at<int>(point.v / kGrid, point.u / kGrid) = point.d;
  std::vector<Support> kept;
  for (const Support& point : all) {
    const int x = point.u / kGrid, y = point.v / kGrid;
    int agree = -1;  // itself
    for (int row = std::max(0, y - kReach); row <= std::min(at.rows - 1, y + kReach); ++row)
      for (int column = std::max(0, x - kReach); column <= std::min(at.cols - 1, x + kReach);
           ++column) {
        const int d = at.at<int>(row, column);
        agree += d != kNone && std::abs(d - point.d) <= kSame;
      }
    if (agree >= kLeastAgree) kept.push_back(point);
  }
  return kept;
}

/// Disparity of the triangles between the points; NaN outside of them.
cv::Mat planes_between(const std::vector<Support>& points, cv::Size size) {
  cv::Mat planes(size, CV_32F, cv::Scalar(kNoEstimate));
  cv::Subdiv2D triangulation(cv::Rect(0, 0, size.width, size.height));
  cv::Mat disparity_at(size, CV_32F, cv::Scalar(kNoEstimate));
  for (const Support& point : points) {
    triangulation.insert(cv::Point2f(float(point.u), float(point.v)));
    disparity_at.at<float>(point.v, point.u) = float(point.d);
  }
  std::vector<cv::Vec6f> triangles;
  triangulation.getTriangleList(triangles);
  const cv::Rect inside(cv::Point(), size);
  for (const cv::Vec6f& corners : triangles) {
    cv::Point places[3];
    cv::Matx33f system;
    cv::Vec3f values;
    bool is_whole = true;
    for (int k = 0; k < 3; ++k) {
      places[k] = {int(corners[2 * k]), int(corners[2 * k + 1])};
      is_whole = is_whole && inside.contains(places[k]);
      if (!is_whole) break;
      for (int c = 0; c < 2; ++c) system(k, c) = corners[2 * k + c];
      system(k, 2) = 1;
      values[k] = disparity_at.at<float>(places[k]);
    }
    if (!is_whole || std::abs(cv::determinant(system)) < 1e-6) continue;
    const cv::Vec3f plane = system.inv() * values;
    const cv::Rect box = cv::boundingRect(std::vector<cv::Point>(places, places + 3));
    const auto side = [&](int k, int u, int v) {
      const cv::Point &a = places[k], &b = places[(k + 1) % 3];
      return (b.x - a.x) * (v - a.y) - (b.y - a.y) * (u - a.x);
    };
    for (int v = box.y; v < box.y + box.height; ++v)
      for (int u = box.x; u < box.x + box.width; ++u) {
        const int sides[] = {side(0, u, v), side(1, u, v), side(2, u, v)};
        const auto [least, most] = std::ranges::minmax(sides);
        const bool is_in = least >= 0 || most <= 0;
        if (is_in) planes.at<float>(v, u) = plane[0] * float(u) + plane[1] * float(v) + plane[2];
      }
  }
  return planes;
}

/// The disparities of the support points of a cell and those around it.
std::vector<std::set<int>> disparities_by_cell(const std::vector<Support>& points, int columns,
                                               int rows) {
  std::vector<std::set<int>> cells(std::size_t(columns) * rows);
  for (const Support& point : points)
    for (int y = point.v / kCell - 1; y <= point.v / kCell + 1; ++y)
      for (int x = point.u / kCell - 1; x <= point.u / kCell + 1; ++x)
        if (x >= 0 && y >= 0 && x < columns && y < rows)
          for (const int near : {-1, 0, 1})
            cells[std::size_t(y) * columns + x].insert(point.d + near);
  return cells;
}

cv::Mat dense(const Sides& sides, const Sides& turned, const RunControl& control) {
  const int width = sides.reference.width, height = sides.reference.height;
  cv::Mat disparity(height, width, CV_32F, cv::Scalar(kNoEstimate));
  const std::vector<Support> points = support_points(sides, turned, control);
  if (points.size() < 3) return disparity;
  const cv::Mat planes = planes_between(points, {width, height});
  const int columns = width / kCell + 1, rows = height / kCell + 1;
  const auto cells = disparities_by_cell(points, columns, rows);
  parallel_for(
      height,
      [&](int v) {
        for (int u = 0; u < width; ++u) {
          const float plane = planes.at<float>(v, u);
          std::set<int> candidates = cells[std::size_t(v / kCell) * columns + u / kCell];
          if (std::isfinite(plane))
            for (int k = -kAround; k <= kAround; ++k)
              candidates.insert(int(std::lround(plane)) + k);
          const auto cost = [&](int d) {
            const int there = std::clamp(u - d, 0, width - 1);
            return kBeta * float(difference(sides.reference.at(u, v), sides.other.at(there, v)));
          };
          float least = std::numeric_limits<float>::infinity();
          int best = 0;
          for (const int d : candidates) {
            if (d < sides.least || d > sides.most || u - d < 0 || u - d >= width) continue;
            float energy = cost(d);
            if (std::isfinite(plane)) {
              const float off = float(d) - plane;
              energy -= std::log(kGamma + std::exp(-off * off / (2 * kSigma * kSigma)));
            }
            if (energy < least) least = energy, best = d;
          }
          if (std::isfinite(least))
            disparity.at<float>(v, u) =
                float(best) + parabola(cost(best - 1), cost(best), cost(best + 1));
        }
      },
      [&](int) { control.throw_if_cancelled(); });
  return disparity;
}

cv::Mat match(const Pair& pair, const RunControl& control) {
  const Pair other_way = pair.turned();
  const Sides sides{described(pair.reference), described(pair.other), pair.least, pair.most};
  const Sides turned{described(other_way.reference), described(other_way.other), pair.least,
                     pair.most};
  const cv::Mat there = dense(sides, turned, control);
  cv::Mat disparity = agreed(there, dense(turned, sides, control), 2);
  fill_from_farther(disparity);
  cv::medianBlur(disparity, disparity, 3);
  return disparity;
}

}  // namespace

Baseline support_points() {
  return {
      "support_points", "Triangulated support points", "after Geiger et al. 2010",
      "16 gradients per pixel; support points every 5 px, ratio of best to second best 0.85, "
      "both sides agree within 1 px; matching 0.02, prior γ 3, σ 1, 3 px around the plane; both "
      "sides agree within 2 px, holes from the farther neighbour, median of 3 × 3; parabola",
      [](const Problem& problem) { return pair_trials(problem, match, 1024); }};
}

}  // namespace gigaray::baselines
