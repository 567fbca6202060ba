// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "scored_pixels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gigaray/core/error.h"

namespace gigaray::metrics {
namespace {

template <class T>
std::string size_of(const Image<T>& map) {
  return std::to_string(map.width()) + " x " + std::to_string(map.height());
}

template <class A, class B>
bool same_size(const Image<A>& a, const Image<B>& b) {
  return a.width() == b.width() && a.height() == b.height();
}

}  // namespace

void check_sizes(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask) {
  if (border < 0)
    throw Error(ErrorCode::kInvalidArgument,
                "border is " + std::to_string(border) + "; it must be 0 or more");
  if (!same_size(estimate, truth))
    throw Error(ErrorCode::kBadInput, "sizes differ: the estimate is " + size_of(estimate) +
                                          ", the truth " + size_of(truth));
  if (!mask.empty() && !same_size(mask, truth))
    throw Error(ErrorCode::kBadInput,
                "sizes differ: the mask is " + size_of(mask) + ", the truth " + size_of(truth));
}

bool is_scored(const FloatMap& truth, int border, const Mask& mask, int u, int v) {
  return u >= border && v >= border && u < truth.width() - border && v < truth.height() - border &&
         std::isfinite(truth(u, v)) && (mask.empty() || mask(u, v));
}

Errors errors_of(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask) {
  check_sizes(estimate, truth, border, mask);
  Errors errors;
  for (int v = border; v < truth.height() - border; ++v) {
    for (int u = border; u < truth.width() - border; ++u) {
      if (!is_scored(truth, border, mask, u, v)) continue;
      ++errors.scored;
      if (std::isfinite(estimate(u, v)))
        errors.of_filled.push_back(double(estimate(u, v)) - double(truth(u, v)));
    }
  }
  return errors;
}

Errors some_errors_of(const FloatMap& estimate, const FloatMap& truth, int border,
                      const Mask& mask) {
  Errors errors = errors_of(estimate, truth, border, mask);
  if (errors.scored == 0)
    throw Error(ErrorCode::kBadInput,
                "nothing to score: no pixel of the " + size_of(truth) + " truth is finite" +
                    (mask.empty() ? "" : ", in the mask") + " and inside the border of " +
                    std::to_string(border) + " px");
  return errors;
}

double quantile(std::vector<double>& values, double p) {
  if (values.empty()) return std::nan("");
  const double place = p * double(values.size() - 1);
  const auto below = std::size_t(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[below];
  if (below + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (place - double(below)) * (high - low);
}

double percent(long part, long whole) {
  return whole == 0 ? std::nan("") : 100.0 * double(part) / double(whole);
}

}  // namespace gigaray::metrics
