// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/region_metrics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "gigaray/core/error.h"
#include "scored_pixels.h"

namespace gigaray {
namespace {

/// Percentage of scored pixels whose estimate is missing or bad(u, v).
template <class Bad>
double share_of(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask,
                Bad bad) {
  metrics::check_sizes(estimate, truth, border, mask);
  long scored = 0, found = 0;
  for (int v = border; v < truth.height() - border; ++v) {
    for (int u = border; u < truth.width() - border; ++u) {
      if (!metrics::is_scored(truth, border, mask, u, v)) continue;
      ++scored;
      found += !std::isfinite(estimate(u, v)) || bad(u, v);
    }
  }
  return metrics::percent(found, scored);
}

/// The middle between the truth of a pixel and the truth of its row in a given column.
double halfway(const FloatMap& truth, int column, int u, int v) {
  return 0.5 * (double(truth(column, v)) + double(truth(u, v)));
}

void check_column(const FloatMap& truth, int column) {
  if (column < 0 || column >= truth.width())
    throw Error(ErrorCode::kBadInput, "a truth of " + std::to_string(truth.width()) +
                                          " columns is no backgammon scene; it needs 15 or more");
}

}  // namespace

double bad_pix(const FloatMap& estimate, const FloatMap& truth, double threshold, int border,
               const Mask& mask) {
  return share_of(estimate, truth, border, mask, [&](int u, int v) {
    return std::abs(double(estimate(u, v)) - double(truth(u, v))) > threshold;
  });
}

double mean_squared_error_x100(const FloatMap& estimate, const FloatMap& truth, int border,
                               const Mask& mask) {
  const metrics::Errors errors = metrics::errors_of(estimate, truth, border, mask);
  double sum = 0;
  for (const double error : errors.of_filled) sum += error * error;
  return 100 * sum / double(errors.of_filled.size());
}

double fine_fattening(const FloatMap& estimate, const FloatMap& truth, int border,
                      const Mask& mask) {
  return share_of(estimate, truth, border, mask, [&](int u, int v) {
    return double(estimate(u, v)) - double(truth(u, v)) > 0.15;
  });
}

double fine_thinning(const FloatMap& estimate, const FloatMap& truth, int border,
                     const Mask& mask) {
  return share_of(estimate, truth, border, mask, [&](int u, int v) {
    return double(truth(u, v)) - double(estimate(u, v)) > 0.15;
  });
}

double backgammon_fattening(const FloatMap& estimate, const FloatMap& truth, int border,
                            const Mask& mask) {
  const int foreground = 14;
  check_column(truth, foreground);
  return share_of(estimate, truth, border, mask, [&](int u, int v) {
    return double(estimate(u, v)) > halfway(truth, foreground, u, v);
  });
}

double backgammon_thinning(const FloatMap& estimate, const FloatMap& truth, int border,
                           const Mask& mask) {
  const int background = truth.width() - 11;
  check_column(truth, background);
  return share_of(estimate, truth, border, mask, [&](int u, int v) {
    return double(estimate(u, v)) < halfway(truth, background, u, v);
  });
}

double missed_dots(const FloatMap& estimate, const FloatMap& truth, const LabelMap& boxes,
                   const LabelMap& dots_by_size) {
  constexpr int kLargestLabel = 8;
  metrics::check_sizes(estimate, truth, 0, {});
  for (const LabelMap* labels : {&boxes, &dots_by_size})
    if (labels->width() != truth.width() || labels->height() != truth.height())
      throw Error(ErrorCode::kBadInput, "a mask of the dots is not as large as the truth");
  std::set<int> box_labels, dot_labels;
  std::map<std::pair<int, int>, std::pair<long, long>> dots;  // pixels, bad ones
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u) {
      const int box = boxes(u, v), dot = dots_by_size(u, v);
      if (box != 0) box_labels.insert(box);
      if (dot == 0 || dot > kLargestLabel) continue;
      dot_labels.insert(dot);
      auto& [pixels, bad] = dots[{box, dot}];
      ++pixels;
      bad += !(std::abs(double(estimate(u, v)) - double(truth(u, v))) <= 0.4);
    }
  }
  long found = 0;
  for (const int box : box_labels)
    for (const int dot : dot_labels) {
      const auto place = dots.find({box, dot});
      found += place != dots.end() && 2 * place->second.second < place->second.first;
    }
  const long total = long(box_labels.size() * dot_labels.size());
  return metrics::percent(total - found, total);
}

Mask mask_near_jumps(const FloatMap& truth) {
  constexpr double kJump = 0.15;
  constexpr int kRadius = 4;
  const int width = truth.width(), height = truth.height();
  Mask near(width, height);
  const auto mark_around = [&](int u, int v) {
    for (int y = std::max(0, v - kRadius); y <= std::min(height - 1, v + kRadius); ++y)
      for (int x = std::max(0, u - kRadius); x <= std::min(width - 1, u + kRadius); ++x)
        if ((x - u) * (x - u) + (y - v) * (y - v) <= kRadius * kRadius) near(x, y) = 1;
  };
  const auto compare = [&](int u, int v, int other_u, int other_v) {
    if (!(std::abs(double(truth(u, v)) - double(truth(other_u, other_v))) > kJump)) return;
    mark_around(u, v);
    mark_around(other_u, other_v);
  };
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (u > 0) compare(u - 1, v, u, v);
      if (v > 0) compare(u, v - 1, u, v);
    }
  }
  return near;
}

}  // namespace gigaray
