// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "scored_pixels.h"

namespace gigaray {
namespace {

/// What both benchmarks are made of: |error| of every pixel with an estimate.
struct Magnitudes {
  Magnitudes(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask) {
    metrics::Errors errors = metrics::some_errors_of(estimate, truth, border, mask);
    scored = errors.scored;
    values = std::move(errors.of_filled);
    for (double& error : values) error = std::abs(error);
  }

  double bad(double threshold) const {
    const long above = std::count_if(values.begin(), values.end(),
                                     [&](double error) { return error > threshold; });
    return metrics::percent(above + scored - long(values.size()), scored);
  }
  double filled() const { return metrics::percent(long(values.size()), scored); }
  double mean() const {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  }
  double mean_square() const {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
           double(values.size());
  }
  double quantile(double p) { return metrics::quantile(values, p); }

  std::vector<double> values;
  long scored = 0;
};

}  // namespace

DisparityScores score_disparity(const FloatMap& estimate, const FloatMap& truth, int border,
                                const Mask& mask) {
  Magnitudes errors(estimate, truth, border, mask);
  DisparityScores scores;
  scores.bad_pix_007 = errors.bad(0.07);
  scores.bad_pix_003 = errors.bad(0.03);
  scores.bad_pix_001 = errors.bad(0.01);
  scores.mse_x100 = 100 * errors.mean_square();
  scores.q25_x100 = 100 * errors.quantile(0.25);
  scores.filled = errors.filled();
  scores.scored = errors.scored;
  return scores;
}

MiddleburyScores score_middlebury(const FloatMap& estimate, const FloatMap& truth, int border,
                                  const Mask& mask) {
  Magnitudes errors(estimate, truth, border, mask);
  MiddleburyScores scores;
  scores.bad_05 = errors.bad(0.5);
  scores.bad_10 = errors.bad(1);
  scores.bad_20 = errors.bad(2);
  scores.bad_40 = errors.bad(4);
  scores.average_error = errors.mean();
  scores.rms = std::sqrt(errors.mean_square());
  scores.a50 = errors.quantile(0.5);
  scores.a90 = errors.quantile(0.9);
  scores.a95 = errors.quantile(0.95);
  scores.a99 = errors.quantile(0.99);
  scores.filled = errors.filled();
  scores.scored = errors.scored;
  return scores;
}

}  // namespace gigaray
