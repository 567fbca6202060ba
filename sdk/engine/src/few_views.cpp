// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "few_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gigaray/core/parallel.h"
#include "gigaray/samplers/any_sampler.h"
#include "noise_rows.h"

namespace gigaray {
namespace {

using reference::Band;
using reference::Sample;

constexpr int kWindow = 3;           // px around a pixel, every second one
constexpr int kReach = kWindow + 3;  // rows, with taps and gradients
constexpr float kGradientWeight = 3;

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
              .value_or(PixelDistance{});
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
std::optional<PixelDistance> distance_at_best(const Band& band, const S& sampler, int u, int v,
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

NoiseEstimate estimate_window_noise(const LightField& light_field, int view,
                                    const HypothesisRange& hypotheses, const RunControl& control) {
  constexpr int kMostRows = 16, kPixelsOfRow = 40;
  const int width = light_field.width, rows = std::min(kMostRows, light_field.height);
  const NoiseRows sampled = load_noise_rows(light_field, view, hypotheses, rows, kReach, control);
  std::vector<std::vector<PixelDistance>> found(sampled.rows.size());
  parallel_for(
      rows,
      [&](int i) {
        const int stride = std::max(width / kPixelsOfRow, 1), v = sampled.rows[i];
        for (int u = stride / 2; u < width; u += stride) {
          control.throw_if_cancelled();
          const double way = longest_way(sampled.sampler, sampled.num_views, hypotheses, u, v);
          const double step = (hypotheses.max - hypotheses.min) / (2 * way);
          const auto distance = std::visit(
              [&](const auto& s) {
                return distance_at_best(sampled.band_of(i), s, u, v, hypotheses, step);
              },
              sampled.sampler);
          if (distance) found[i].push_back(*distance);
        }
      },
      [&](int) { control.throw_if_cancelled(); });
  std::vector<float> colour, gradient;
  for (const auto& row : found)
    for (const PixelDistance& distance : row) {
      colour.push_back(distance.colour);
      gradient.push_back(distance.gradient);
    }
  return {percentile(colour, 0.25), percentile(gradient, 0.25), 0, view};
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
