// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/core/image.h"

namespace gigaray::metrics {

/// Errors of the pixels that are scored: truth finite, inside the border, in the mask.
struct Errors {
  std::vector<double> of_filled;  ///< estimate - truth where there is an estimate
  long scored = 0;                ///< all pixels to score, filled or not
  long unfilled() const { return scored - long(of_filled.size()); }
};

/// Throws Error(kBadInput) when sizes differ, Error(kInvalidArgument) when the border is negative.
void check_sizes(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask);

/// True where a pixel of the checked maps is scored.
bool is_scored(const FloatMap& truth, int border, const Mask& mask, int u, int v);

/// May find nothing to score.
Errors errors_of(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask);

/// The same, but throws Error(kBadInput) when nothing is left to score.
Errors some_errors_of(const FloatMap& estimate, const FloatMap& truth, int border,
                      const Mask& mask);

/// The p-th part of the sorted values, p in [0, 1], linear between neighbours; NaN without values.
/// Reorders `values`.
double quantile(std::vector<double>& values, double p);

/// 100 part / whole; NaN when the whole is 0.
double percent(long part, long whole);

}  // namespace gigaray::metrics
