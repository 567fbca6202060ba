// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "disparity_range.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "edge_matches.h"
#include "gigaray/core/arguments.h"
#include "gigaray/samplers/any_sampler.h"

namespace gigaray {
namespace {

constexpr int kMostPixels = 3000;
// Of two views a single pixel tells little over a wide range: windows, and fewer of them.
constexpr int kWindowOfTwo = 2, kMostPixelsOfTwo = 1000;

/// A search of the whole range that views on a line or in a plane can have.
struct WideSearch {
  std::vector<PixelMatch> matches;
  HypothesisRange range;
  int level = 0;
  double radius = 0;  ///< view steps from the first view to the farthest one
};

/// band: of the views.
WideSearch search_widely(const LightField& views, const reference::Band& band,
                         const RunControl& control, int most_pixels) {
  WideSearch search;
  search.level = band.shape.level;
  for (const View& view : views.views)
    search.radius =
        std::max(search.radius, std::hypot(view.s - views.views[0].s, view.t - views.views[0].t));
  // A step moves the outermost view by half a pixel of the small pictures; the search ends where
  // neighbouring views differ by a sixteenth of the width, two by a quarter.
  const double scale = double(1 << band.shape.level);
  const bool two = band.num_views == 2;
  const double most = band.shape.width / (two ? 4.0 : 16.0) * scale,
               step = 0.5 / search.radius * scale;
  search.range = {-most, most, int(std::ceil(2 * most / step)) | 1};
  const bool is_4d = views.kind != LightFieldKind::k3D;
  search.matches = std::visit(
      [&](const auto& sampler) {
        return match_edges(band, sampler, is_4d, search.range, control,
                           two ? std::min(most_pixels, kMostPixelsOfTwo) : most_pixels,
                           two ? kWindowOfTwo : 0);
      },
      make_sampler(views));
  return search;
}

double mean_score(const std::vector<PixelMatch>& matches) {
  double sum = 0;
  for (const PixelMatch& match : matches) sum += match.score;
  return matches.empty() ? 0 : sum / double(matches.size());
}

}  // namespace

std::vector<int> central_views(const LightField& light_field) {
  constexpr std::size_t kMostViews = 9;
  std::vector<int> views = views_from_centre(light_field);
  views.resize(std::min(views.size(), kMostViews));
  return views;
}

LightField central(const LightField& light_field) {
  return subset(light_field, central_views(light_field));
}

namespace {

void check_rows_of_views(const LightField& light_field) {
  check(light_field);
  require_argument(light_field.kind != LightFieldKind::kUnstructured,
                   "light_field: has cameras; disparities are those of 3D and 4D ones");
}

}  // namespace

double measure_agreement(const LightField& light_field, const std::vector<int>& views,
                         SmallViews& small, const RunControl& control) {
  return mean_score(search_widely(subset(light_field, views), small.band(views, control), control,
                                  kMostPixels / 5)
                        .matches);
}

double measure_agreement(const LightField& light_field, const RunControl& control) {
  check_rows_of_views(light_field);
  std::vector<int> all(light_field.views.size());
  std::iota(all.begin(), all.end(), 0);
  SmallViews small(light_field);
  return measure_agreement(light_field, all, small, control);
}

RangeEstimate estimate_disparity_range(const LightField& light_field, const RunControl& control) {
  check_rows_of_views(light_field);
  SmallViews small(light_field);
  return estimate_disparity_range(light_field, small, control);
}

RangeEstimate estimate_disparity_range(const LightField& light_field, SmallViews& small,
                                       const RunControl& control) {
  const std::vector<int> views = central_views(light_field);
  const auto [matches, search, level, radius] =
      search_widely(subset(light_field, views), small.band(views, control), control, kMostPixels);
  RangeEstimate estimate;
  estimate.pixel_size = 1 << level;
  estimate.radius = radius;
  estimate.agreement = mean_score(matches);
  std::vector<float> reliable;
  for (const PixelMatch& match : matches) {
    if (!is_reliable(match)) continue;
    reliable.push_back(match.disparity);
    estimate.matches.push_back({match.u << level, match.v << level, match.disparity});
  }
  constexpr std::size_t kLeast = 30;
  if (reliable.size() < kLeast)
    throw Error(
        ErrorCode::kBadInput,
        "the disparity range can't be estimated: too little in the pictures matches; give it "
        "with DepthOptions::disparity");
  std::sort(reliable.begin(), reliable.end());
  const auto percentile = [&](double p) {
    return double(reliable[std::size_t(p * double(reliable.size() - 1))]);
  };
  const double low = percentile(0.003), high = percentile(0.997);
  const double margin = std::max(0.12 * (high - low), search.step());
  estimate.range = {low - margin, high + margin};
  estimate.samples = long(reliable.size());
  for (const float d : reliable) estimate.negative_share += (d < 0) / double(reliable.size());
  return estimate;
}

}  // namespace gigaray
