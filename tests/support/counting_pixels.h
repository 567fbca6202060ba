// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "gigaray/core/light_field.h"

namespace gigaray::testing_support {

/// Counts how often each picture is read, as if every read had to decode it.
class CountingPixels : public PixelSource {
 public:
  CountingPixels(std::shared_ptr<const PixelSource> pixels, int num_views)
      : pixels_(std::move(pixels)), counts_(std::size_t(num_views)) {}

  Image<std::uint16_t> read(int view_idx) const override {
    ++counts_.at(std::size_t(view_idx));
    return pixels_->read(view_idx);
  }
  bool has_mask() const override { return pixels_->has_mask(); }
  int bit_depth() const override { return pixels_->bit_depth(); }

  int count(int view_idx) const { return counts_.at(std::size_t(view_idx)); }
  int total() const {
    int sum = 0;
    for (const auto& count : counts_) sum += count;
    return sum;
  }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  mutable std::vector<std::atomic<int>> counts_;
};

/// Puts one beneath the light field.
inline std::shared_ptr<CountingPixels> count_reads(LightField& light_field) {
  const auto counting =
      std::make_shared<CountingPixels>(light_field.pixels, light_field.num_views());
  light_field.pixels = counting;
  return counting;
}

}  // namespace gigaray::testing_support
