// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "gigaray/core/error.h"
#include "gigaray/core/metrics.h"
#include "scored_pixels.h"

namespace gigaray {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool is_depth(float value) { return std::isfinite(value) && value > 0; }

/// An order that has nothing to do with the place in the picture.
std::uint64_t shuffled(std::uint64_t index) {
  index *= 0x9e3779b97f4a7c15u;
  index ^= index >> 32;
  return index * 0xd6e8feb86659fd93u;
}

}  // namespace

void DepthErrors::add(const FloatMap& estimate, const FloatMap& truth, const FloatMap& confidence,
                      int border) {
  metrics::check_sizes(estimate, truth, border, {});
  if (confidence.empty())
    has_confidence_ = false;
  else
    metrics::check_sizes(confidence, truth, border, {});
  for (int v = border; v < truth.height() - border; ++v) {
    for (int u = border; u < truth.width() - border; ++u) {
      if (!is_depth(truth(u, v))) continue;
      ++scored_;
      if (!is_depth(estimate(u, v))) continue;
      const float sure = confidence.empty() ? 0 : confidence(u, v);
      filled_.push_back({float(std::abs(double(estimate(u, v)) / double(truth(u, v)) - 1)),
                         std::isnan(sure) ? -std::numeric_limits<float>::infinity() : sure});
    }
  }
}

DepthScores DepthErrors::scores_of(const std::vector<Pixel>& filled) const {
  DepthScores scores;
  scores.scored = scored_;
  scores.filled = metrics::percent(long(filled.size()), scored_);
  for (std::size_t i = 0; i < scores.within.size(); ++i) {
    const float limit = float(DepthScores::kWithinPercent[i] / 100);
    const long within = std::count_if(filled.begin(), filled.end(),
                                      [&](const Pixel& pixel) { return pixel.error <= limit; });
    scores.within[i] = metrics::percent(within, scored_);
    scores.within_filled[i] = metrics::percent(within, long(filled.size()));
  }
  std::vector<double> errors;
  errors.reserve(filled.size());
  for (const Pixel& pixel : filled) errors.push_back(pixel.error);
  scores.median = 100 * metrics::quantile(errors, 0.5);
  return scores;
}

DepthScores DepthErrors::scores() const { return scores_of(filled_); }

DepthScores DepthErrors::most_confident(double percent) const {
  if (!(percent >= 0 && percent <= 100))
    throw Error(ErrorCode::kInvalidArgument, "the share of pixels to keep is " +
                                                 std::to_string(percent) +
                                                 " %; it must be from 0 to 100");
  if (!has_confidence_) {
    DepthScores unknown;
    unknown.within.fill(kNaN);
    unknown.within_filled.fill(kNaN);
    unknown.median = unknown.filled = kNaN;
    unknown.scored = scored_;
    return unknown;
  }
  const std::size_t kept =
      std::min(filled_.size(), std::size_t(std::lround(percent / 100 * double(scored_))));
  std::vector<std::size_t> order(filled_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(kept), order.end(),
                   [&](std::size_t a, std::size_t b) {
                     if (filled_[a].confidence != filled_[b].confidence)
                       return filled_[a].confidence > filled_[b].confidence;
                     return shuffled(a) < shuffled(b);
                   });
  std::vector<Pixel> chosen;
  chosen.reserve(kept);
  for (std::size_t i = 0; i < kept; ++i) chosen.push_back(filled_[order[i]]);
  return scores_of(chosen);
}

}  // namespace gigaray
