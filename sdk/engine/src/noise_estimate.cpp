// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <optional>

#include "gigaray/parallel.h"
#include "gigaray/samplers/any_sampler.h"
#include "gigaray/scene_estimates.h"
#include "picture_bands.h"
#include "reference/band.h"

namespace gigaray {
namespace {

using reference::Band;
using reference::Sample;

constexpr int kGrid = 8;  // px between the pixels that are measured

/// Of the pixels of one row of the first view.
struct RowNoise {
  std::vector<float> colour, gradient, lead;
};

template <RaySampler S>
RowNoise measure_row(const Band& band, const S& sampler, int v, const HypothesisRange& hypotheses,
                     const RunControl& control) {
  constexpr float kColourCap = 0.3f, kGradientCap = 0.2f;
  RowNoise row;
  for (int u = kGrid / 2; u < band.shape.width; u += kGrid) {
    control.throw_if_cancelled();
    const Sample own = band.pixel(0, u, v);
    if (std::abs(own[0] - 0.5F) > reference::kMaskedBeyond) continue;
    float best_colour = kColourCap, best_gradient = kGradientCap, sum_of_all = 0;
    int tested = 0;
    for (int h = 0; h < hypotheses.count; ++h) {
      const Ray ray{double(u), double(v), hypotheses.value(h)};
      float sum_colour = 0, sum_gradient = 0;
      int count = 0;
      for (int other = 1; other < band.num_views; ++other) {
        const auto there = sampler.locate(0, other, ray);
        const auto sample =
            there ? reference::sample_at(band, other, there->u, there->v, true) : std::nullopt;
        if (!sample) continue;
        sum_colour += std::min(kColourCap, reference::colour_distance(*sample, own));
        sum_gradient +=
            std::min(kGradientCap, std::hypot((*sample)[3] - own[3], (*sample)[4] - own[4]));
        ++count;
      }
      if (2 * count < band.num_views - 1) continue;
      sum_of_all += sum_colour / count;
      ++tested;
      best_colour = std::min(best_colour, sum_colour / count);
      best_gradient = std::min(best_gradient, sum_gradient / count);
    }
    if (tested > 0) row.lead.push_back(sum_of_all / tested / std::max(best_colour, 1e-4f) - 1);
    row.colour.push_back(best_colour);
    row.gradient.push_back(best_gradient);
  }
  return row;
}

/// The centre view first, then some of those that it is compared with.
std::vector<int> noise_views(const LightField& light_field, std::size_t most) {
  const int centre = centre_view(light_field);
  std::vector<int> partners =
      std::visit([&](const auto& s) { return s.partners(centre); }, make_sampler(light_field));
  std::vector<int> chosen{centre};
  const std::size_t stride = (partners.size() + most - 1) / most;
  for (std::size_t i = 0; i < partners.size(); i += stride)
    if (partners[i] != centre) chosen.push_back(partners[i]);
  return chosen;
}

}  // namespace

NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control) {
  constexpr int kMostRows = 16;
  // Of unstructured views a row needs much of each.
  const bool unstructured = light_field.kind == LightFieldKind::kUnstructured;
  const LightField views = subset(light_field, noise_views(light_field, unstructured ? 9 : 25));

  // The rows, each with what it reaches in other views; in one band where that is much.
  const int height = light_field.height;
  const int rows = std::min(kMostRows, std::max(1, height / kGrid));
  std::vector<RowRange> needed;
  std::vector<int> centres;
  const AnySampler sampler = make_sampler(views);
  int rows_of_all = 0;
  for (int i = 0; i < rows; ++i) {
    const int v = int((i + 0.5) * height / rows);
    centres.push_back(v);
    needed.push_back(std::visit(
        [&](const auto& s) {
          return s.rows_needed(0, grown({v, v + 1}, 3, height), hypotheses, height);
        },
        sampler));
    rows_of_all += needed.back().size();
  }
  const bool together = rows_of_all > height;
  if (together) needed.assign(1, {0, height});
  std::vector<Band> bands;
  for (const RowRange& range : needed) {
    Band band{{0, light_field.width, height}, range, views.num_views(), 5, {}};
    band.data.resize(std::size_t(range.size()) * band.num_views * 5 * band.shape.width);
    bands.push_back(std::move(band));
  }
  control.progress("noise", 0, views.num_views());
  parallel_for(
      views.num_views(),
      [&](int view) {
        const EncodedView rows_of_view(views, view);
        for (Band& band : bands) place(rows_of_view.band(band.rows, 5), view, band);
      },
      [&](int done) { control.progress("noise", done, views.num_views()); },
      pictures_at_once(views));

  std::vector<RowNoise> found(centres.size());
  parallel_for(
      int(centres.size()),
      [&](int i) {
        const Band& band = bands[together ? 0 : std::size_t(i)];
        std::visit(
            [&](const auto& s) {
              found[i] = measure_row(band, s, centres[i], hypotheses, control);
            },
            sampler);
      },
      [&](int) { control.throw_if_cancelled(); });
  std::vector<float> colour, gradient, lead;
  for (const RowNoise& row : found) {
    colour.insert(colour.end(), row.colour.begin(), row.colour.end());
    gradient.insert(gradient.end(), row.gradient.begin(), row.gradient.end());
    lead.insert(lead.end(), row.lead.begin(), row.lead.end());
  }
  const auto smallest = [](std::vector<float>& values, double share) {
    if (values.empty()) return 0.0;
    const auto at = values.begin() + long(share * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
  };
  return {smallest(colour, 0.25), smallest(gradient, 0.25), smallest(lead, 0.5)};
}

void apply_noise(const NoiseEstimate& noise, DepthOptions& options) {
  options.score.bandwidth = std::max(kLeastBandwidth, float(3 * noise.colour));
  options.score.gradient_bandwidth = std::max(kLeastGradientBandwidth, float(2 * noise.gradient));
  options.support.sigma_colour = float(std::max(0.03, 2 * noise.colour));
}

double ray_doubt(const NoiseEstimate& noise, double lead, int others) {
  constexpr double kRamp = 0.4, kMany = 16;
  // Mean colour distance of wrong hypotheses. Strong texture tells all that rays need, and a wide
  // window would only blunt its silhouettes.
  constexpr double kWeakTexture = 0.02, kStrongTexture = 0.03;
  const double contrast = noise.colour * (1 + noise.lead);
  const auto ramp = [](double value) { return std::clamp(value, 0.0, 1.0); };
  const double of_noise = (noise.colour > kLeastNoise) * ramp((kLeadOfOwnPixel - lead) / kRamp) *
                          ramp((kStrongTexture - contrast) / (kStrongTexture - kWeakTexture));
  const double of_views = (1.0 / others - 1 / kMany) / (1 - 1 / kMany);
  return std::max(of_noise, ramp(of_views));
}

void apply_doubt(double doubt, DepthOptions& options) {
  SupportOptions& support = options.support;
  ScoreOptions& score = options.score;
  score.gradient_share += float(doubt) * (score.gradient_share_in_doubt - score.gradient_share);
  if (support.radius == 0) return;
  // In even steps: each radius has kernels of its own.
  const int radius =
      support.radius + 2 * int(std::lround(doubt * (support.radius_in_doubt - support.radius) / 2));
  support.sigma_space *= float(radius) / float(support.radius);
  support.radius = radius;
}

}  // namespace gigaray
