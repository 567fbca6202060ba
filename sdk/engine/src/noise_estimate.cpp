// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "gigaray/engine/scene_estimates.h"
#include "noise_rows.h"

namespace gigaray {
namespace {

using reference::Band;
using reference::Sample;

constexpr int kGrid = 8;  // px between the pixels that are measured

/// How far one other view is off, of some pixels.
struct OtherNoise {
  std::vector<float> colour;  ///< where all agree best
  double gradient = 0, gradient_elsewhere = 0;

  void add(const OtherNoise& more) {
    colour.insert(colour.end(), more.colour.begin(), more.colour.end());
    gradient += more.gradient;
    gradient_elsewhere += more.gradient_elsewhere;
  }
};

/// Of the pixels of one row of the first view.
struct RowNoise {
  std::vector<float> colour, gradient, lead;
  std::vector<OtherNoise> of_others;
};

/// Adds how far each other view is off on a ray of the hypothesis where all agree best, and on one
/// where they don't.
template <RaySampler S>
void add_others(const Band& band, const S& sampler, const Ray& best, const Ray& elsewhere,
                const Sample& own, std::vector<OtherNoise>& of_others) {
  const auto gradient_distance = [&](const Sample& sample) {
    return double(std::hypot(sample[3] - own[3], sample[4] - own[4]));
  };
  const auto seen = [&](int other, const Ray& ray) {
    const auto there = sampler.locate(0, other, ray);
    return there ? reference::sample_at(band, other, there->u, there->v, true) : std::nullopt;
  };
  for (int other = 1; other < band.num_views; ++other) {
    const auto here = seen(other, best), there = seen(other, elsewhere);
    if (!here || !there) continue;
    of_others[other].colour.push_back(reference::colour_distance(*here, own));
    of_others[other].gradient += gradient_distance(*here);
    of_others[other].gradient_elsewhere += gradient_distance(*there);
  }
}

template <RaySampler S>
RowNoise measure_row(const Band& band, const S& sampler, int v, const HypothesisRange& hypotheses,
                     const RunControl& control) {
  RowNoise row;
  row.of_others.resize(band.num_views);
  for (int u = kGrid / 2; u < band.shape.width; u += kGrid) {
    control.throw_if_cancelled();
    const Sample own = band.pixel(0, u, v);
    if (std::abs(own[0] - 0.5F) > reference::kMaskedBeyond) continue;
    PixelDistance best;
    int best_hypothesis = -1;
    float sum_of_all = 0;
    int tested = 0;
    for (int h = 0; h < hypotheses.count; ++h) {
      const auto distance =
          distance_of(band, sampler, Ray{double(u), double(v), hypotheses.value(h)}, own);
      if (!distance) continue;
      sum_of_all += distance->colour;
      ++tested;
      if (distance->colour < best.colour) best_hypothesis = h;
      best.colour = std::min(best.colour, distance->colour);
      best.gradient = std::min(best.gradient, distance->gradient);
    }
    if (best_hypothesis >= 0) {
      const int elsewhere = (best_hypothesis + hypotheses.count / 2) % hypotheses.count;
      add_others(band, sampler, Ray{double(u), double(v), hypotheses.value(best_hypothesis)},
                 Ray{double(u), double(v), hypotheses.value(elsewhere)}, own, row.of_others);
    }
    if (tested > 0) row.lead.push_back(sum_of_all / tested / std::max(best.colour, 1e-4f) - 1);
    row.colour.push_back(best.colour);
    row.gradient.push_back(best.gradient);
  }
  return row;
}

/// What one view says.
struct ViewNoise {
  NoiseEstimate estimate;
  bool is_measured = false;  ///< it agrees with others somewhere
  std::vector<int> strays;   ///< others that show something else than the rest does
};

/// Others whose pixels are far off where most agree, with gradients that fit no better than
/// anywhere else: pictures of another exposure are far off too, but their gradients fit.
std::vector<int> strays_of(const std::vector<int>& views, std::vector<OtherNoise>& of_others) {
  constexpr double kFarOff = 0.1, kTimesMost = 4, kNoBetter = 0.8;
  std::vector<float> medians;
  for (std::size_t other = 1; other < views.size(); ++other)
    medians.push_back(float(percentile(of_others[other].colour, 0.5)));
  std::vector<float> sorted = medians;
  const double most = percentile(sorted, 0.5);
  std::vector<int> strays;
  for (std::size_t i = 0; i < medians.size(); ++i) {
    const OtherNoise& other = of_others[i + 1];
    if (medians[i] > std::max(kFarOff, kTimesMost * most) &&
        other.gradient > kNoBetter * other.gradient_elsewhere)
      strays.push_back(views[i + 1]);
  }
  return strays;
}

ViewNoise measure_view(const LightField& light_field, int view, int most_rows,
                       const HypothesisRange& hypotheses, const RunControl& control,
                       const std::vector<int>& without) {
  constexpr int kReach = 3;
  const int rows = std::min(most_rows, std::max(1, light_field.height / kGrid));
  const NoiseRows sampled =
      load_noise_rows(light_field, view, hypotheses, rows, kReach, control, without);
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
  std::vector<OtherNoise> of_others(sampled.views.size());
  for (const RowNoise& row : found) {
    colour.insert(colour.end(), row.colour.begin(), row.colour.end());
    gradient.insert(gradient.end(), row.gradient.begin(), row.gradient.end());
    lead.insert(lead.end(), row.lead.begin(), row.lead.end());
    for (std::size_t i = 0; i < of_others.size(); ++i) of_others[i].add(row.of_others[i]);
  }
  constexpr double kNearCap = 0.9;  // it agrees with nobody
  ViewNoise result;
  result.estimate = {percentile(colour, 0.25), percentile(gradient, 0.25), percentile(lead, 0.5),
                     view};
  result.is_measured =
      !lead.empty() && result.estimate.colour < kNearCap * PixelDistance::kColourCap;
  result.strays = strays_of(sampled.views, of_others);
  return result;
}

/// The same, of posed views without what its partners show that is something else.
ViewNoise measure_posed(const LightField& light_field, int view, const HypothesisRange& hypotheses,
                        const RunControl& control) {
  constexpr int kMostRows = 8;
  ViewNoise found = measure_view(light_field, view, kMostRows, hypotheses, control, {});
  if (!found.is_measured || found.strays.empty()) return found;
  return measure_view(light_field, view, kMostRows, hypotheses, control, found.strays);
}

/// Some views that are compared with others, spread over all.
std::vector<int> views_to_measure(const LightField& light_field) {
  constexpr int kMostViews = 5;
  const AnySampler sampler = make_sampler(light_field);
  std::vector<int> compared;
  for (int view = 0; view < light_field.num_views(); ++view)
    if (std::visit([&](const auto& s) { return s.partners(view).size(); }, sampler) > 1)
      compared.push_back(view);
  const int count = std::min(kMostViews, int(compared.size()));
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i)
    chosen.push_back(compared[std::size_t(2 * i + 1) * compared.size() / (2 * count)]);
  return chosen;
}

}  // namespace

NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control) {
  check(light_field);
  require_argument(std::isfinite(hypotheses.min) && hypotheses.min < hypotheses.max &&
                       std::isfinite(hypotheses.max) && hypotheses.count >= 2,
                   "hypotheses: two or more of a range of finite numbers are needed");
  constexpr int kMostRows = 16;
  const bool is_posed = light_field.kind == LightFieldKind::kUnstructured;
  const int centre = centre_view(light_field);
  if (!is_posed) {
    const ViewNoise found = measure_view(light_field, centre, kMostRows, hypotheses, control, {});
    if (found.is_measured) return found.estimate;
  }
  std::vector<NoiseEstimate> measured;
  for (const int view : views_to_measure(light_field)) {
    const ViewNoise found =
        is_posed ? measure_posed(light_field, view, hypotheses, control)
                 : measure_view(light_field, view, kMostRows, hypotheses, control, {});
    if (found.is_measured) measured.push_back(found.estimate);
  }
  if (measured.empty()) {
    control.message("no view agrees with others anywhere: pictures are taken as free of noise");
    return {0, 0, kLeadOfOwnPixel, centre};
  }
  const auto middle = measured.begin() + long((measured.size() - 1) / 2);
  std::ranges::nth_element(measured, middle, {}, &NoiseEstimate::colour);
  return *middle;
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
