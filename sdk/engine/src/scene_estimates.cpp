// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/scene_estimates.h"

#include <algorithm>
#include <cmath>

#include "gigaray/samplers/any_sampler.h"
#include "reference/density_score.h"
#include "reference/downsample.h"
#include "reference/edge_confidence.h"
#include "reference/unpack_channels.h"

namespace gigaray {
namespace {

using reference::Band;
using reference::Sample;

/// A few views of a light field as a light field of its own.
LightField subset(const LightField& light_field, const std::vector<int>& views) {
  class Subset : public PixelSource {
   public:
    Subset(std::shared_ptr<const PixelSource> all, std::vector<int> views)
        : all_(std::move(all)), views_(std::move(views)) {}
    Image<std::uint16_t> read(int view_idx) const override {
      return all_->read(views_.at(view_idx));
    }
    int bit_depth() const override { return all_->bit_depth(); }

   private:
    std::shared_ptr<const PixelSource> all_;
    std::vector<int> views_;
  };
  LightField some = light_field;
  some.views.clear();
  for (const int view : views) some.views.push_back(light_field.views[view]);
  some.pixels = std::make_shared<Subset>(light_field.pixels, views);
  return some;
}

/// A view as a band of its own, encoded RGB (and gradients), all rows.
Band view_band(const LightField& light_field, int view, int channels) {
  const Image<std::uint16_t> picture = read_view(light_field, view);
  Band band{{0, picture.width(), picture.height()}, {0, picture.height()}, 1, channels, {}};
  band.data.resize(picture.size() / 3 * channels);
  std::vector<float> table(std::size_t(1) << light_field.pixels->bit_depth());
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = float(i) / float(table.size() - 1);
  // Values above 8 bits or not: the decoder always gives 16-bit integers.
  reference::unpack_channels(picture.data(), BandEncoding::kBits16, table, band);
  return band;
}

/// Copies some rows of a view's own band to its place in a band of all views.
void place(const Band& view_rows, int view, Band& band) {
  for (int v = band.rows.begin; v < band.rows.end; ++v)
    for (int c = 0; c < band.channels; ++c)
      std::copy_n(view_rows.plane(0, v, c), band.shape.width, band.plane(view, v, c));
}

ScoreOptions colour_score(float bandwidth) {
  ScoreOptions score;
  score.gradient = true;
  score.gradient_share = 0;  // the triangle kernel of colour alone
  score.bandwidth = bandwidth;
  score.min_views = 0.6f;
  score.mean_shift_iterations = 0;
  return score;
}

struct PixelMatch {
  int u = 0, v = 0;  // px of the small pictures
  float disparity = 0;
  float score = 0;
  float lead = 0;  ///< over the best hypothesis elsewhere
};

constexpr int kSmallWidth = 320;  // px; the search runs on pictures no wider than this
constexpr int kMostViews = 9;     // around the centre
constexpr int kMostPixels = 3000;
constexpr float kReliableScore = 0.6f, kReliableLead = 0.15f;

/// The views of the line or square around the centre that the search looks at.
std::vector<int> central_views(const LightField& light_field, int count) {
  std::vector<int> views = views_from_centre(light_field);
  views.resize(std::min<std::size_t>(views.size(), count));
  return views;
}

Band small_band(const LightField& views) {
  Band all;
  for (int view = 0; view < views.num_views(); ++view) {
    Band one = view_band(views, view, 3);
    while (one.shape.width > kSmallWidth && std::min(one.shape.width, one.shape.height) > 32) {
      Band next{{one.shape.level + 1, (one.shape.width + 1) / 2, (one.shape.height + 1) / 2},
                {0, (one.shape.height + 1) / 2},
                1,
                3,
                {}};
      next.data.resize(std::size_t(next.shape.width) * next.shape.height * 3);
      reference::downsample(one, next.rows, next.data.data());
      one = std::move(next);
    }
    if (view == 0) {
      all = Band{one.shape, one.rows, views.num_views(), 3, {}};
      all.data.resize(one.data.size() * views.num_views());
    }
    place(one, view, all);
  }
  return all;
}

/// The best hypothesis of the pixels with the strongest edges of view 0 of a band.
template <RaySampler S>
std::vector<PixelMatch> match_edges(const Band& band, const S& level0_sampler, bool is_4d,
                                    const HypothesisRange& range, const RunControl& control) {
  const S sampler = level0_sampler.at_level(band.shape.level);
  StripMap<float> edges(band.shape.width, band.rows);
  reference::edge_confidence(band, 0, band.rows, EdgeOptions{2, false, 0, false}, is_4d, edges);
  struct Pixel {
    float edge;
    int u, v;
  };
  std::vector<Pixel> pixels;
  for (int v = 2; v < band.shape.height - 2; v += 2)
    for (int u = 2; u < band.shape.width - 2; u += 2) pixels.push_back({edges.row(v)[u], u, v});
  const std::size_t count = std::min<std::size_t>(pixels.size() / 3, kMostPixels);
  std::nth_element(pixels.begin(), pixels.begin() + count, pixels.end(),
                   [](const Pixel& a, const Pixel& b) { return a.edge > b.edge; });
  pixels.resize(count);

  const ScoreOptions score = colour_score(0.08f);
  std::vector<PixelMatch> matches;
  std::vector<float> scores(range.count);
  for (const Pixel& pixel : pixels) {
    control.throw_if_cancelled();
    if (pixel.edge < 0.1f) continue;  // a flat picture tells nothing
    for (int i = 0; i < range.count; ++i)
      scores[i] = reference::density_score(
          band, sampler, 0, Ray{double(pixel.u), double(pixel.v), range.value(i)}, score);
    const int best = int(std::max_element(scores.begin(), scores.end()) - scores.begin());
    float elsewhere = 0;
    for (int i = 0; i < range.count; ++i)
      if (std::abs(i - best) > 6) elsewhere = std::max(elsewhere, scores[i]);
    matches.push_back(
        {pixel.u, pixel.v, float(range.value(best)), scores[best], scores[best] - elsewhere});
  }
  return matches;
}

}  // namespace

RangeEstimate estimate_disparity_range(const LightField& light_field, const RunControl& control) {
  const LightField views = subset(light_field, central_views(light_field, kMostViews));
  const Band band = small_band(views);
  double radius = 0;
  for (const View& view : views.views)
    radius = std::max(radius, std::hypot(view.s - views.views[0].s, view.t - views.views[0].t));
  // A step moves the outermost view by half a pixel of the small pictures; the search ends where
  // neighbouring views differ by a sixteenth of the width.
  const double scale = double(1 << band.shape.level);
  const double most = band.shape.width / 16.0 * scale, step = 0.5 / radius * scale;
  const HypothesisRange search{-most, most, int(std::ceil(2 * most / step)) | 1};
  const bool is_4d = light_field.kind != LightFieldKind::k3D;
  const std::vector<PixelMatch> matches = std::visit(
      [&](const auto& sampler) { return match_edges(band, sampler, is_4d, search, control); },
      make_sampler(views));

  RangeEstimate estimate;
  estimate.pixel_size = 1 << band.shape.level;
  estimate.radius = radius;
  std::vector<float> reliable;
  for (const PixelMatch& match : matches) {
    estimate.agreement += match.score / double(matches.size());
    if (match.score <= kReliableScore || match.lead <= kReliableLead) continue;
    reliable.push_back(match.disparity);
    estimate.matches.push_back(
        {match.u << band.shape.level, match.v << band.shape.level, match.disparity});
  }
  constexpr std::size_t kLeast = 30;
  if (reliable.size() < kLeast)
    throw Error(
        ErrorCode::kBadInput,
        "the disparity range can't be estimated: too little in the pictures matches; give it "
        "with --disparity MIN MAX");
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

NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control) {
  constexpr int kGrid = 8, kMostRows = 16;
  constexpr std::size_t kMostNoiseViews = 25;
  std::vector<int> chosen{centre_view(light_field)};
  const std::size_t all_views = light_field.views.size();
  const std::size_t stride = (all_views + kMostNoiseViews - 1) / kMostNoiseViews;
  for (std::size_t i = 0; i < all_views; i += stride)
    if (int(i) != chosen[0]) chosen.push_back(int(i));
  const LightField views = subset(light_field, chosen);

  // The rows, each with what it reaches in other views.
  const int height = light_field.height;
  const int rows = std::min(kMostRows, std::max(1, height / kGrid));
  std::vector<Band> bands;
  std::vector<int> centres;
  const AnySampler sampler = make_sampler(views);
  for (int i = 0; i < rows; ++i) {
    const int v = int((i + 0.5) * height / rows);
    centres.push_back(v);
    const RowRange needed = std::visit(
        [&](const auto& s) {
          return s.rows_needed(grown({v, v + 1}, 3, height), hypotheses, height);
        },
        sampler);
    Band band{{0, light_field.width, height}, needed, views.num_views(), 5, {}};
    band.data.resize(std::size_t(needed.size()) * band.num_views * 5 * band.shape.width);
    bands.push_back(std::move(band));
  }
  for (int view = 0; view < views.num_views(); ++view) {
    control.progress("noise", view, views.num_views());
    const Band one = view_band(views, view, 5);
    for (Band& band : bands) place(one, view, band);
  }

  constexpr float kColourCap = 0.3f, kGradientCap = 0.2f;
  std::vector<float> colour, gradient, lead;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Band& band = bands[i];
    for (int u = kGrid / 2; u < light_field.width; u += kGrid) {
      const Sample own = band.pixel(0, u, centres[i]);
      float best_colour = kColourCap, best_gradient = kGradientCap, sum_of_all = 0;
      int tested = 0;
      for (int h = 0; h < hypotheses.count; ++h) {
        const Ray ray{double(u), double(centres[i]), hypotheses.value(h)};
        float sum_colour = 0, sum_gradient = 0;
        int count = 0;
        std::visit(
            [&](const auto& s) {
              for (int other = 1; other < views.num_views(); ++other) {
                const auto there = s.locate(0, other, ray);
                const auto sample =
                    there ? reference::sample_at(band, other, there->u, there->v, true)
                          : std::nullopt;
                if (!sample) continue;
                sum_colour += std::min(kColourCap, reference::colour_distance(*sample, own));
                sum_gradient += std::min(kGradientCap,
                                         std::hypot((*sample)[3] - own[3], (*sample)[4] - own[4]));
                ++count;
              }
            },
            sampler);
        if (2 * count < views.num_views() - 1) continue;
        sum_of_all += sum_colour / count;
        ++tested;
        best_colour = std::min(best_colour, sum_colour / count);
        best_gradient = std::min(best_gradient, sum_gradient / count);
      }
      if (tested > 0) lead.push_back(sum_of_all / tested / std::max(best_colour, 1e-4f) - 1);
      colour.push_back(best_colour);
      gradient.push_back(best_gradient);
    }
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
  options.score.bandwidth = std::max(kLeastBandwidth, float(4 * noise.colour));
  options.score.gradient_bandwidth = std::max(kLeastGradientBandwidth, float(2.5 * noise.gradient));
  options.support.sigma_colour = float(std::max(0.03, 2 * noise.colour));
}

}  // namespace gigaray
