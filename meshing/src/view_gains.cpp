// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "view_gains.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "gigaray/core/srgb.h"

namespace gigaray {
namespace {

constexpr std::size_t kMostPoints = 20000;
/// Values outside say little of the exposure.
constexpr int kDarkest = 10, kBrightest = 245;
/// Logarithms that are farther apart are of other points: gloss, depth that is off.
constexpr double kSame = 0.1;
constexpr int kRounds = 8;
/// Keeps the gains of views near 1, in points.
constexpr double kPrior = 0.05;

/// Mean of the linear light around a place, weights falling to 0 at 2 px; nothing near the rims and
/// where it is too dark or bright.
std::optional<std::array<float, 3>> log_light_at(const DepthView& view, float u, float v) {
  const int u0 = int(std::floor(u)) - 1, v0 = int(std::floor(v)) - 1;
  if (u0 < 0 || v0 < 0 || u0 + 3 >= view.picture.width() || v0 + 3 >= view.picture.height())
    return std::nullopt;
  std::array<double, 3> sum{};
  double weights = 0;
  for (int y = v0; y < v0 + 4; ++y)
    for (int x = u0; x < u0 + 4; ++x) {
      const double weight = (2 - std::abs(u - float(x))) * (2 - std::abs(v - float(y)));
      for (int k = 0; k < 3; ++k) {
        const int value = view.byte(x, y, k);
        if (value < kDarkest || value > kBrightest) return std::nullopt;
        sum[k] += weight * linear_from_srgb(value / 255.0);
      }
      weights += weight;
    }
  std::array<float, 3> result{};
  for (int k = 0; k < 3; ++k) result[k] = float(std::log(sum[k] / weights));
  return result;
}

}  // namespace

ViewGains::ViewGains(const SurfaceMesh& mesh, int num_views)
    : num_views_(num_views),
      step_(std::max<std::size_t>(1, mesh.positions.size() / kMostPoints)),
      points_(mesh.positions.size() / step_) {}

void ViewGains::look(int view, const MeshSight& sight, const DepthView& own) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto vertex = std::uint32_t(i * step_);
    if (!sight.sees_vertex(vertex)) continue;
    const Eigen::Vector3f& place = sight.places()[vertex];
    const auto light = log_light_at(own, place.x(), place.y());
    if (light) points_[i].push_back({view, *light});
  }
}

Eigen::VectorXd ViewGains::solve(int channel) const {
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(num_views_);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd matrix = kPrior * Eigen::MatrixXd::Identity(num_views_, num_views_);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(num_views_);
    std::vector<double> weights, lights;
    for (const std::vector<Seen>& point : points_) {
      if (point.size() < 2) continue;
      lights.clear();
      for (const Seen& seen : point) lights.push_back(seen.log_light[channel] + gains[seen.view]);
      std::ranges::nth_element(lights, lights.begin() + std::ptrdiff_t(lights.size() / 2));
      const double middle = lights[lights.size() / 2];
      weights.clear();
      double sum = 0, mean = 0;
      for (const Seen& seen : point) {
        const double gap = (seen.log_light[channel] + gains[seen.view] - middle) / kSame;
        // The first round knows no gains yet.
        weights.push_back(round == 0 ? 1 : 1 / (1 + gap * gap));
        sum += weights.back();
        mean += weights.back() * seen.log_light[channel];
      }
      mean /= sum;
      for (std::size_t i = 0; i < point.size(); ++i) {
        matrix(point[i].view, point[i].view) += weights[i];
        right[point[i].view] -= weights[i] * (point[i].log_light[channel] - mean);
        for (std::size_t k = 0; k < point.size(); ++k)
          matrix(point[i].view, point[k].view) -= weights[i] * weights[k] / sum;
      }
    }
    gains = matrix.ldlt().solve(right);
  }
  return gains;
}

std::vector<Eigen::Array3d> ViewGains::gains() const {
  std::vector<Eigen::Array3d> result(std::size_t(num_views_), Eigen::Array3d::Ones());
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd logs = solve(k);
    for (int view = 0; view < num_views_; ++view)
      result[std::size_t(view)][k] = std::exp(logs[view]);
  }
  return result;
}

ValueTable table_of(const Eigen::Array3d& gain) {
  ValueTable table{};
  for (int k = 0; k < 3; ++k)
    for (int value = 0; value < 256; ++value) {
      const double light = std::min(1.0, gain[k] * linear_from_srgb(value / 255.0));
      table[k][value] = std::uint8_t(std::lround(255 * srgb_from_linear(light)));
    }
  return table;
}

}  // namespace gigaray
