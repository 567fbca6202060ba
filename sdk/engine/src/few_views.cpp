// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "few_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gigaray/parallel.h"
#include "gigaray/samplers/any_sampler.h"
#include "picture_bands.h"
#include "reference/band.h"

namespace gigaray {
namespace {

using reference::Band;
using reference::Sample;

constexpr int kWindow = 3;           // px around a pixel, every second one
constexpr int kReach = kWindow + 3;  // rows, with taps and gradients
constexpr float kColourCap = 0.3f, kGradientCap = 0.2f, kGradientWeight = 3;

struct Distance {
  float colour = kColourCap, gradient = kGradientCap;
};

/// Mean over the other views that see the point, capped; empty: fewer than half do.
template <RaySampler S>
std::optional<Distance> distance_of(const Band& band, const S& sampler, const Ray& ray,
                                    const Sample& own) {
  Distance sum{0, 0};
  int count = 0;
  for (int other = 1; other < band.num_views; ++other) {
    const auto there = sampler.locate(0, other, ray);
    const auto sample =
        there ? reference::sample_at(band, other, there->u, there->v, true) : std::nullopt;
    if (!sample) continue;
    sum.colour += std::min(kColourCap, reference::colour_distance(*sample, own));
    sum.gradient +=
        std::min(kGradientCap, std::hypot((*sample)[3] - own[3], (*sample)[4] - own[4]));
    ++count;
  }
  if (2 * count < band.num_views - 1 || count == 0) return std::nullopt;
  return Distance{sum.colour / float(count), sum.gradient / float(count)};
}

template <RaySampler S>
float window_distance(const Band& band, const S& sampler, int u, int v, double hypothesis) {
  float sum = 0;
  int count = 0;
  for (int y = v - kWindow; y <= v + kWindow; y += 2)
    for (int x = u - kWindow; x <= u + kWindow; x += 2) {
      if (y < 0 || y >= band.shape.height || x < 0 || x >= band.shape.width) continue;
      ++count;
      const auto distance =
          distance_of(band, sampler, Ray{double(x), double(y), hypothesis}, band.pixel(0, x, y))
              .value_or(Distance{});
      sum += distance.colour + kGradientWeight * distance.gradient;
    }
  return sum / float(std::max(count, 1));
}

/// Way in the view where a point moves most, px.
double longest_way(const AnySampler& sampler, int num_views, const HypothesisRange& range, double u,
                   double v) {
  double most = 1;
  for (int other = 1; other < num_views; ++other) {
    const auto [near, far] = std::visit(
        [&](const auto& s) {
          return std::pair(s.locate(0, other, {u, v, range.max}),
                           s.locate(0, other, {u, v, range.min}));
        },
        sampler);
    if (near && far) most = std::max(most, std::hypot(near->u - far->u, near->v - far->v));
  }
  return most;
}

/// How far a pixel is off under the hypothesis that its window likes best; `step` moves it by half
/// a pixel.
template <RaySampler S>
std::optional<Distance> distance_at_best(const Band& band, const S& sampler, int u, int v,
                                         const HypothesisRange& range, double step) {
  const Sample own = band.pixel(0, u, v);
  if (std::abs(own[0] - 0.5F) > reference::kMaskedBeyond) return std::nullopt;
  double best = range.min;
  float least = std::numeric_limits<float>::infinity();
  const auto test = [&](double hypothesis) {
    const float distance = window_distance(band, sampler, u, v, hypothesis);
    if (distance >= least) return;
    least = distance;
    best = hypothesis;
  };
  for (int i = 0; range.min + i * step <= range.max; ++i) test(range.min + i * step);
  const double whole = best;
  for (int i = -4; i <= 4; ++i) test(whole + 0.25 * i * step);
  return distance_of(band, sampler, Ray{double(u), double(v), best}, own);
}

}  // namespace

int most_others(const LightField& light_field) {
  const AnySampler sampler = make_sampler(light_field);
  std::size_t most = 0;
  for (int view = 0; view < light_field.num_views(); ++view)
    most =
        std::max(most, std::visit([&](const auto& s) { return s.partners(view).size(); }, sampler));
  return int(most) - 1;
}

void adapt_to_few_views(const LightField& light_field, DepthOptions& options) {
  const int others = most_others(light_field);
  SupportOptions& support = options.support;
  support.fill_hidden = support.fill_hidden && others == 1;
  if (!options.score.from_noise) return;
  // What one view says, chance says too; several seldom agree by chance.
  const float fewer =
      std::clamp(float(kMostFewViews + 1 - others) / float(kMostFewViews), 0.0f, 1.0f);
  const float few = fewer * fewer;
  constexpr float kMoreJumpPrice = 2, kMoreJumpSigma = 3;
  support.jump_price *= 1 + kMoreJumpPrice * few;
  support.jump_sigma_colour *= 1 + kMoreJumpSigma * few;
}

NoiseEstimate estimate_window_noise(const LightField& light_field,
                                    const HypothesisRange& hypotheses, const RunControl& control) {
  constexpr int kRows = 16, kPixelsOfRow = 40;
  const int centre = centre_view(light_field);
  std::vector<int> chosen{centre};
  for (const int view :
       std::visit([&](const auto& s) { return s.partners(centre); }, make_sampler(light_field)))
    if (view != centre) chosen.push_back(view);
  const LightField views = subset(light_field, chosen);
  const AnySampler sampler = make_sampler(views);
  const int width = views.width, height = views.height, rows = std::min(kRows, height);

  std::vector<RowRange> needed;
  std::vector<int> centres;
  int rows_of_all = 0;
  for (int i = 0; i < rows; ++i) {
    const int v = int((i + 0.5) * height / rows);
    centres.push_back(v);
    needed.push_back(std::visit(
        [&](const auto& s) {
          return s.rows_needed(0, grown({v, v + 1}, kReach, height), hypotheses, height);
        },
        sampler));
    rows_of_all += needed.back().size();
  }
  // Of unstructured views a row may need much of each: then all rows once.
  const bool together = rows_of_all > height;
  if (together) needed.assign(1, {0, height});
  std::vector<Band> bands;
  for (const RowRange& range : needed) {
    Band band{{0, width, height}, range, views.num_views(), reference::kMaxChannels, {}};
    band.data.resize(std::size_t(range.size()) * band.num_views * band.channels * width);
    bands.push_back(std::move(band));
  }
  parallel_for(
      views.num_views(),
      [&](int view) {
        const EncodedView rows_of_view(views, view);
        for (Band& band : bands) place(rows_of_view.band(band.rows, band.channels), view, band);
      },
      [&](int done) { control.progress("noise", done, views.num_views()); },
      pictures_at_once(views));

  std::vector<std::vector<Distance>> found(centres.size());
  parallel_for(
      rows,
      [&](int i) {
        const int stride = std::max(width / kPixelsOfRow, 1);
        for (int u = stride / 2; u < width; u += stride) {
          control.throw_if_cancelled();
          const double way = longest_way(sampler, views.num_views(), hypotheses, u, centres[i]);
          const double step = (hypotheses.max - hypotheses.min) / (2 * way);
          const auto distance = std::visit(
              [&](const auto& s) {
                return distance_at_best(bands[together ? 0 : std::size_t(i)], s, u, centres[i],
                                        hypotheses, step);
              },
              sampler);
          if (distance) found[i].push_back(*distance);
        }
      },
      [&](int) { control.throw_if_cancelled(); });
  std::vector<float> colour, gradient;
  for (const auto& row : found)
    for (const Distance& distance : row) {
      colour.push_back(distance.colour);
      gradient.push_back(distance.gradient);
    }
  const auto smallest_quarter = [](std::vector<float>& values) {
    if (values.empty()) return 0.0;
    const auto at = values.begin() + long(values.size() / 4);
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
  };
  return {smallest_quarter(colour), smallest_quarter(gradient), 0};
}

void widen(const NoiseEstimate& noise, DepthOptions& options) {
  DepthOptions wide = options;
  apply_noise(noise, wide);
  options.score.bandwidth = std::max(options.score.bandwidth, wide.score.bandwidth);
  options.score.gradient_bandwidth =
      std::max(options.score.gradient_bandwidth, wide.score.gradient_bandwidth);
  options.support.sigma_colour = std::max(options.support.sigma_colour, wide.support.sigma_colour);
}

}  // namespace gigaray
