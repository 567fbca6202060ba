// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// The values of a map that are known, rising.
class SortedValues {
 public:
  explicit SortedValues(const FloatMap& map) : total_(map.size()) {
    std::copy_if(map.begin(), map.end(), std::back_inserter(values_),
                 [](float value) { return std::isfinite(value); });
    std::sort(values_.begin(), values_.end());
  }
  bool empty() const { return values_.empty(); }
  /// Of the pixels, 0 … 1.
  double share() const { return total_ ? double(values_.size()) / double(total_) : 0; }
  /// at: 0 the least, 0.5 the median, 1 the largest. There must be one.
  float quantile(double at) const {
    return values_.at(std::size_t(std::lround(at * double(values_.size() - 1))));
  }
  /// Of the known values, 0 … 1.
  double share_above(float least) const {
    const auto first = std::upper_bound(values_.begin(), values_.end(), least);
    return values_.empty() ? 0 : double(values_.end() - first) / double(values_.size());
  }

 private:
  std::vector<float> values_;
  std::size_t total_;
};

}  // namespace gigaray
