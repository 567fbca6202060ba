// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>

#include "gigaray/parallel.h"
#include "gigaray/scene_estimates.h"
#include "noise_rows.h"

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
  RowNoise row;
  for (int u = kGrid / 2; u < band.shape.width; u += kGrid) {
    control.throw_if_cancelled();
    const Sample own = band.pixel(0, u, v);
    if (std::abs(own[0] - 0.5F) > reference::kMaskedBeyond) continue;
    PixelDistance best;
    float sum_of_all = 0;
    int tested = 0;
    for (int h = 0; h < hypotheses.count; ++h) {
      const auto distance =
          distance_of(band, sampler, Ray{double(u), double(v), hypotheses.value(h)}, own);
      if (!distance) continue;
      sum_of_all += distance->colour;
      ++tested;
      best.colour = std::min(best.colour, distance->colour);
      best.gradient = std::min(best.gradient, distance->gradient);
    }
    if (tested > 0) row.lead.push_back(sum_of_all / tested / std::max(best.colour, 1e-4f) - 1);
    row.colour.push_back(best.colour);
    row.gradient.push_back(best.gradient);
  }
  return row;
}

}  // namespace

NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control) {
  constexpr int kMostRows = 16, kReach = 3;
  const int rows = std::min(kMostRows, std::max(1, light_field.height / kGrid));
  const NoiseRows sampled = load_noise_rows(light_field, hypotheses, rows, kReach, control);
  std::vector<RowNoise> found(sampled.rows.size());
  parallel_for(
      rows,
      [&](int i) {
        std::visit(
            [&](const auto& s) {
              found[i] = measure_row(sampled.band_of(i), s, sampled.rows[i], hypotheses, control);
            },
            sampled.sampler);
      },
      [&](int) { control.throw_if_cancelled(); });
  std::vector<float> colour, gradient, lead;
  for (const RowNoise& row : found) {
    colour.insert(colour.end(), row.colour.begin(), row.colour.end());
    gradient.insert(gradient.end(), row.gradient.begin(), row.gradient.end());
    lead.insert(lead.end(), row.lead.begin(), row.lead.end());
  }
  return {percentile(colour, 0.25), percentile(gradient, 0.25), percentile(lead, 0.5)};
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
