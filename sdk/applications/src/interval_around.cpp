// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/interval_around.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

constexpr double kFarther = 0.1;  // of the range of the map
constexpr double kLow = 0.01, kHigh = 0.99;

void check_pixel(const FloatMap& map, int u, int v) {
  require_argument(u >= 0 && v >= 0 && u < map.width() && v < map.height() && map.channels() == 1,
                   "u, v: must be a pixel of the map, which has one channel");
}

std::vector<float> known_values(const FloatMap& map) {
  std::vector<float> values;
  std::copy_if(map.begin(), map.end(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  return values;
}

/// Of what is there; the order of the values changes.
float quantile(std::vector<float>& values, double at) {
  const auto place = values.begin() + std::lround(at * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

float range_of(const FloatMap& map) {
  std::vector<float> values = known_values(map);
  return values.empty() ? 0 : quantile(values, kHigh) - quantile(values, kLow);
}

}  // namespace

std::optional<float> value_around(const FloatMap& map, int u, int v, float jump) {
  check_pixel(map, u, v);
  const float own = map(u, v);
  if (!std::isfinite(own)) return std::nullopt;
  std::vector<float> values;
  for (int row = std::max(v - 1, 0); row <= std::min(v + 1, map.height() - 1); ++row)
    for (int column = std::max(u - 1, 0); column <= std::min(u + 1, map.width() - 1); ++column)
      if (std::abs(map(column, row) - own) <= jump) values.push_back(map(column, row));
  return values.empty() ? own : quantile(values, 0.5);
}

float jump_of(const FloatMap& map, float step) {
  constexpr float kSteps = 2, kOfRange = 0.015f;
  return std::max(kSteps * step, kOfRange * range_of(map));
}

ValueInterval interval_around(const FloatMap& map, int u, int v, float value, float jump) {
  check_pixel(map, u, v);
  require_argument(std::isfinite(value) && jump >= 0,
                   "value, jump: finite numbers are needed, the jump 0 or more");
  const auto farthest = std::max(float(kFarther * range_of(map)), jump);
  Mask seen(map.width(), map.height());
  std::vector<std::pair<int, int>> front{{u, v}};
  std::vector<float> surface{value};
  seen(u, v) = 1;
  while (!front.empty()) {
    const auto [at_u, at_v] = front.back();
    front.pop_back();
    surface.push_back(map(at_u, at_v));
    constexpr std::array<std::pair<int, int>, 4> kWays{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [right, down] : kWays) {
      const int next_u = at_u + right, next_v = at_v + down;
      if (next_u < 0 || next_v < 0 || next_u >= map.width() || next_v >= map.height()) continue;
      const float next = map(next_u, next_v);
      // NaN fails both.
      if (seen(next_u, next_v) || !(std::abs(next - map(at_u, at_v)) <= jump) ||
          !(std::abs(next - value) <= farthest))
        continue;
      seen(next_u, next_v) = 1;
      front.emplace_back(next_u, next_v);
    }
  }
  const float margin = jump / 2;
  return {std::min(quantile(surface, kLow), value) - margin,
          std::max(quantile(surface, kHigh), value) + margin};
}

}  // namespace gigaray
