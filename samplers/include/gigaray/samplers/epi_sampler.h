// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/ray_sampler.h"

namespace GIGARAY_API gigaray {

/// 3D light fields: views on a line, rays of a scene point form a straight line in one
/// epipolar-plane image (eq. 3). Rows of different v never meet.
class EpiSampler {
 public:
  static constexpr std::string_view kKernelFile = "epi_sampler.cl";
  static constexpr int kRayTableWidth = 1;  ///< ŝ − s
  static constexpr bool kRaysShiftAlike = true;

  /// Positions s of all views, in view steps. Throws Error(kBadInput) when a view has another t.
  explicit EpiSampler(const std::vector<View>& views);

  int num_views() const { return int(s_.size()); }
  std::optional<Ray> locate(int ref, int other, Ray ray) const {
    return Ray{ray.u + (s_[ref] - s_[other]) * ray.hypothesis, ray.v, ray.hypothesis};
  }
  std::vector<int> partners(int) const { return all_views(num_views()); }
  RowRange rows_needed(int, RowRange rows, HypothesisRange, int height) const {
    return grown(rows, 0, height);
  }
  EpiSampler at_level(int level) const;
  EpiSampler subset(const std::vector<int>& views) const;
  std::vector<float> ray_table(int ref) const;

 private:
  EpiSampler() = default;
  std::vector<double> s_;  // times 2^-level
};
static_assert(RaySampler<EpiSampler>);

}  // namespace gigaray
