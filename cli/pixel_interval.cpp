// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pixel_interval.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "gigaray/interval_around.h"

namespace gigaray::cli {
namespace {

Error bad(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// Where there is an estimate, for who pointed beside it.
std::string nearest_known(const FloatMap& map, int u, int v) {
  double nearest = std::numeric_limits<double>::infinity();
  std::string place;
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const double away = std::hypot(column - u, row - v);
      if (!std::isfinite(map(column, row)) || away >= nearest) continue;
      nearest = away;
      place = fmt::format("; the nearest pixel with one is {} {}", column, row);
    }
  return place.empty() ? "; no pixel has one" : place;
}

}  // namespace

PixelInterval::PixelInterval(const DepthResult& depth, const FloatMap& disparity,
                             const std::vector<int>& at, std::optional<double> tolerance)
    : geometry_(depth.light_field()), view_(depth.top_view()), at_(at) {
  const int u = at.at(0), v = at.at(1);
  const std::string& name = geometry_.views[view_].name;
  if (u < 0 || v < 0 || u >= disparity.width() || v >= disparity.height())
    throw bad(fmt::format("--at {} {} is outside of view {}, which has {} × {} px", u, v, name,
                          disparity.width(), disparity.height()));
  const int steps = depth.hypotheses() - 1;
  const double step = steps > 0 ? (depth.searched().max - depth.searched().min) / steps : 0;
  const float jump = jump_of(disparity, float(step));
  const std::optional<float> value = value_around(disparity, u, v, jump);
  if (!value)
    throw bad(fmt::format("--at {} {}: view {} has no estimate there{}", u, v, name,
                          nearest_known(disparity, u, v)));
  value_ = *value;
  const bool posed = geometry_.kind == LightFieldKind::kUnstructured;
  if (posed && !(value_ > 0))
    throw bad(fmt::format("--at {} {}: what view {} sees there is at infinity", u, v, name));
  if (!tolerance) {
    values_ = interval_around(disparity, u, v, value_, jump);
    if (posed) values_.least = std::max(values_.least, 0.0f);
  } else if (posed) {
    if (*tolerance >= 1)
      throw bad(
          fmt::format("--tolerance {}: of photographs with cameras it is a share of the inverse "
                      "depth, less than 1",
                      *tolerance));
    values_ = {float(value_ * (1 - *tolerance)), float(value_ * (1 + *tolerance))};
  } else {
    values_ = {float(value_ - *tolerance), float(value_ + *tolerance)};
  }
}

ValueInterval PixelInterval::values_in(int view) const {
  if (geometry_.kind != LightFieldKind::kUnstructured || view == view_) return values_;
  const Eigen::Vector3d point = geometry_.cameras[view_].back_project(at_[0], at_[1], 1 / value_);
  const double depth = geometry_.cameras[view].project(point).z();
  if (!(depth > 0)) return {1, 0};
  const double there = 1 / depth / value_;
  return {float(values_.least * there), float(values_.most * there)};
}

nlohmann::ordered_json PixelInterval::json() const {
  return {{"view", geometry_.views[view_].name}, {"u", at_[0]}, {"v", at_[1]}, {"value", value_}};
}

}  // namespace gigaray::cli
