// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/ray_sampler.h"

namespace GIGARAY_API gigaray {

/// 4D light fields: parallel views at any real positions (s, t) of a plane; complete grids,
/// crosses, stars and measured positions alike (eq. 9).
class GridSampler {
 public:
  static constexpr std::string_view kKernelFile = "grid_sampler.cl";
  static constexpr int kRayTableWidth = 2;  ///< ŝ − s, t̂ − t
  static constexpr bool kRaysShiftAlike = true;

  explicit GridSampler(const std::vector<View>& views);

  int num_views() const { return int(positions_.size()); }
  std::optional<Ray> locate(int ref, int other, Ray ray) const {
    const Position from = positions_[ref];
    const Position to = positions_[other];
    return Ray{ray.u + (from.s - to.s) * ray.hypothesis, ray.v + (from.t - to.t) * ray.hypothesis,
               ray.hypothesis};
  }
  std::vector<int> partners(int) const { return all_views(num_views()); }
  RowRange rows_needed(int ref, RowRange rows, HypothesisRange range, int height) const;
  GridSampler at_level(int level) const;
  GridSampler subset(const std::vector<int>& views) const;
  std::vector<float> ray_table(int ref) const;

 private:
  GridSampler() = default;
  struct Position {
    double s, t;  // times 2^-level
  };
  std::vector<Position> positions_;
};
static_assert(RaySampler<GridSampler>);

}  // namespace gigaray
