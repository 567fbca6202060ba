// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/metrics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gigaray/error.h"

namespace gigaray {
namespace {

/// The p-th part of the sorted values, p in [0, 1], linear between neighbours. Reorders `values`.
double percentile(std::vector<double>& values, double p) {
  const double place = p * double(values.size() - 1);
  const auto below = std::size_t(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[below];
  if (below + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (place - double(below)) * (high - low);
}

template <class T>
std::string size_of(const Image<T>& map) {
  return std::to_string(map.width()) + " x " + std::to_string(map.height());
}

}  // namespace

DisparityScores score_disparity(const FloatMap& estimate, const FloatMap& truth, int border,
                                const Mask& mask) {
  if (border < 0)
    throw Error(ErrorCode::kInvalidArgument,
                "border is " + std::to_string(border) + "; it must be 0 or more");
  if (estimate.width() != truth.width() || estimate.height() != truth.height())
    throw Error(ErrorCode::kBadInput, "sizes differ: the estimate is " + size_of(estimate) +
                                          ", the truth " + size_of(truth));
  if (!mask.empty() && (mask.width() != truth.width() || mask.height() != truth.height()))
    throw Error(ErrorCode::kBadInput,
                "sizes differ: the mask is " + size_of(mask) + ", the truth " + size_of(truth));

  long scored = 0, above_007 = 0, above_003 = 0, above_001 = 0;
  double sum_of_squares = 0;
  std::vector<double> errors;
  for (int v = border; v < truth.height() - border; ++v) {
    for (int u = border; u < truth.width() - border; ++u) {
      if (!std::isfinite(truth(u, v)) || (!mask.empty() && !mask(u, v))) continue;
      ++scored;
      if (!std::isfinite(estimate(u, v))) continue;
      const double error = std::abs(double(estimate(u, v)) - double(truth(u, v)));
      errors.push_back(error);
      sum_of_squares += error * error;
      above_007 += error > 0.07;
      above_003 += error > 0.03;
      above_001 += error > 0.01;
    }
  }
  if (scored == 0)
    throw Error(ErrorCode::kBadInput, "nothing to score: no pixel of the " + size_of(truth) +
                                          " truth is finite and " + "inside the border of " +
                                          std::to_string(border) + " px");

  const long unfilled = scored - long(errors.size());
  const auto percent = [&](long count) { return 100.0 * double(count) / double(scored); };
  DisparityScores scores;
  scores.bad_pix_007 = percent(above_007 + unfilled);
  scores.bad_pix_003 = percent(above_003 + unfilled);
  scores.bad_pix_001 = percent(above_001 + unfilled);
  scores.filled = percent(long(errors.size()));
  scores.scored = scored;
  scores.mse_x100 = scores.q25_x100 = std::nan("");
  if (!errors.empty()) {
    scores.mse_x100 = 100 * sum_of_squares / double(errors.size());
    scores.q25_x100 = 100 * percentile(errors, 0.25);
  }
  return scores;
}

}  // namespace gigaray
