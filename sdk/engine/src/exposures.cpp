// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/exposures.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "edge_matches.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "gigaray/samplers/unstructured_sampler.h"
#include "noise_rows.h"
#include "picture_bands.h"

namespace gigaray {
namespace {

using reference::Band;

constexpr int kWindow = 3;  // px of the small pictures on each side
constexpr int kPixels = (2 * kWindow + 1) * (2 * kWindow + 1);

/// The colours of a window of view 0, or of where another view sees it.
struct Window {
  std::array<float, kPixels> grey{};
  std::array<float, 3> mean{};

  void add(int i, const Band& band, int view, int u, int v) {
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
      const float value = band.plane(view, v, c)[u];
      mean[c] += value / kPixels;
      sum += value;
    }
    grey[i] = sum / 3;
  }
  bool is_exposed() const {
    constexpr float kDark = 0.04f, kBright = 0.96f;
    return std::all_of(mean.begin(), mean.end(),
                       [](float value) { return value > kDark && value < kBright; });
  }
};

float correlation(const Window& a, const Window& b) {
  float sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int i = 0; i < kPixels; ++i) {
    sum_a += a.grey[i];
    sum_b += b.grey[i];
    aa += a.grey[i] * a.grey[i];
    bb += b.grey[i] * b.grey[i];
    ab += a.grey[i] * b.grey[i];
  }
  constexpr float kFlat = 1e-5f;
  const float n = kPixels, va = aa / n - sum_a * sum_a / n / n, vb = bb / n - sum_b * sum_b / n / n;
  return va > kFlat && vb > kFlat ? (ab / n - sum_a * sum_b / n / n) / std::sqrt(va * vb) : 0;
}

/// The pixels nearest to where view `other` sees a window, as if it were flat.
std::optional<Window> window_seen(const Band& band, const UnstructuredSampler& sampler, int other,
                                  const Ray& ray) {
  const auto at = sampler.locate(0, other, ray);
  const auto right = sampler.locate(0, other, Ray{ray.u + 1, ray.v, ray.hypothesis});
  const auto below = sampler.locate(0, other, Ray{ray.u, ray.v + 1, ray.hypothesis});
  if (!at || !right || !below) return std::nullopt;
  Window window;
  int i = 0;
  for (int dv = -kWindow; dv <= kWindow; ++dv)
    for (int du = -kWindow; du <= kWindow; ++du) {
      const double u = at->u + du * (right->u - at->u) + dv * (below->u - at->u);
      const double v = at->v + du * (right->v - at->v) + dv * (below->v - at->v);
      if (!(u >= 0 && v >= 0 && u <= band.shape.width - 1 && v <= band.shape.height - 1))
        return std::nullopt;
      window.add(i++, band, other, int(std::lround(u)), int(std::lround(v)));
    }
  return window;
}

/// How much brighter view `other` is than view 0 of a band; empty: too little of them matches.
std::optional<Exposure> brighter(const Band& band, const UnstructuredSampler& sampler, int other,
                                 const std::vector<EdgePixel>& pixels, int hypotheses) {
  constexpr float kLike = 0.9f, kLead = 0.05f;
  constexpr int kApart = 3;  // hypotheses
  constexpr std::size_t kLeastMatches = 12;
  std::array<std::vector<float>, 3> ratios;
  for (const EdgePixel& pixel : pixels) {
    Window own;
    int i = 0;
    for (int dv = -kWindow; dv <= kWindow; ++dv)
      for (int du = -kWindow; du <= kWindow; ++du)
        own.add(i++, band, 0, pixel.u + du, pixel.v + dv);
    if (!own.is_exposed()) continue;
    std::vector<float> like(std::size_t(hypotheses), -1.0f);
    Window found;
    int best = -1;
    for (int h = 0; h < hypotheses; ++h) {
      const Ray ray{double(pixel.u), double(pixel.v), h / double(hypotheses - 1)};
      const auto window = window_seen(band, sampler, other, ray);
      if (!window) continue;
      like[h] = correlation(own, *window);
      if (best >= 0 && like[h] <= like[best]) continue;
      best = h;
      found = *window;
    }
    if (best < 0 || like[best] < kLike || !found.is_exposed()) continue;
    float elsewhere = -1;
    for (int h = 0; h < hypotheses; ++h)
      if (std::abs(h - best) > kApart) elsewhere = std::max(elsewhere, like[h]);
    if (like[best] - elsewhere < kLead) continue;
    for (int c = 0; c < 3; ++c) ratios[c].push_back(std::log(found.mean[c] / own.mean[c]));
  }
  if (ratios[0].size() < kLeastMatches) return std::nullopt;
  Exposure result{};
  for (int c = 0; c < 3; ++c) result[c] = float(percentile(ratios[c], 0.5));
  return result;
}

/// No picture is made brighter for the sake of one that is brighter than most by more than this.
constexpr float kBrightest = 0.35f;

/// b is brighter than a by so much.
struct Difference {
  int a = 0, b = 0;
  Exposure by{};
};

std::vector<Exposure> exposures_of(int views, const std::vector<Difference>& differences) {
  // A little weight on "as all others": views that nothing ties to them have 0.
  constexpr double kAsOthers = 1e-3;
  Eigen::MatrixXd normal = kAsOthers * Eigen::MatrixXd::Identity(views, views);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(views, 3);
  for (const Difference& d : differences) {
    normal(d.a, d.a) += 1;
    normal(d.b, d.b) += 1;
    normal(d.a, d.b) -= 1;
    normal(d.b, d.a) -= 1;
    for (int c = 0; c < 3; ++c) {
      right(d.a, c) -= d.by[c];
      right(d.b, c) += d.by[c];
    }
  }
  const Eigen::MatrixXd solved = normal.ldlt().solve(right);
  std::vector<Exposure> exposures(views);
  for (int c = 0; c < 3; ++c) {
    std::vector<float> sorted;
    for (int view = 0; view < views; ++view) sorted.push_back(float(solved(view, c)));
    const float usual = float(percentile(sorted, 0.5));
    const float brightest =
        std::min(*std::max_element(sorted.begin(), sorted.end()), usual + kBrightest);
    for (int view = 0; view < views; ++view)
      exposures[view][c] = float(solved(view, c)) - brightest;
  }
  return exposures;
}

/// Pictures with the exposure taken out.
class EvenedPixels : public PixelSource {
 public:
  EvenedPixels(std::shared_ptr<const PixelSource> pixels, std::vector<Exposure> exposures)
      : pixels_(std::move(pixels)), exposures_(std::move(exposures)) {}
  Image<std::uint16_t> read(int view_idx) const override {
    Image<std::uint16_t> picture = pixels_->read(view_idx);
    const int most = (1 << bit_depth()) - 1, clipped = most - most / 50;
    std::array<std::vector<std::uint16_t>, 3> even;
    for (int c = 0; c < 3; ++c) {
      const float factor = std::exp(-exposures_[view_idx][c]);
      for (int value = 0; value < clipped; ++value)
        even[c].push_back(std::uint16_t(std::lround(std::min(factor * value, float(most)))));
    }
    for (int v = 0; v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u) {
        if (std::max({picture(u, v, 0), picture(u, v, 1), picture(u, v, 2)}) >= clipped) continue;
        for (int c = 0; c < 3; ++c) picture(u, v, c) = even[c][picture(u, v, c)];
      }
    return picture;
  }
  bool has_mask() const override { return pixels_->has_mask(); }
  int bit_depth() const override { return pixels_->bit_depth(); }
  void let_go(int view_idx) const override { pixels_->let_go(view_idx); }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  std::vector<Exposure> exposures_;
};

}  // namespace

std::vector<Exposure> estimate_exposures(const LightField& light_field, const RunControl& control) {
  check(light_field);
  require_argument(light_field.kind == LightFieldKind::kUnstructured,
                   "light_field: exposures are estimated of photographs with cameras");
  constexpr int kMostPixels = 150;
  constexpr std::size_t kMostPartners = 3;
  const UnstructuredSampler all(light_field.cameras, light_field.most_partners);
  SmallViews small(light_field);
  std::vector<Difference> differences;
  for (int ref = 0; ref < light_field.num_views(); ++ref) {
    control.progress("exposures", ref, light_field.num_views());
    std::vector<int> chosen = all.nearest_partners(ref, kMostPartners);
    if (chosen.empty()) continue;
    chosen.insert(chosen.begin(), ref);
    const Band band = small.band(chosen, control);
    const UnstructuredSampler views = all.subset(chosen).at_level(band.shape.level);
    const std::vector<EdgePixel> pixels = strongest_edges(band, true, 4, kWindow, kMostPixels);
    std::vector<std::optional<Exposure>> found(chosen.size());
    parallel_for(
        int(chosen.size()) - 1,
        [&](int i) {
          constexpr double kLeast = 16, kMost = 128;
          const double travel = all.travel(ref, chosen[i + 1]) / (1 << band.shape.level);
          found[i + 1] = brighter(band, views, i + 1, pixels,
                                  int(std::clamp(std::ceil(travel), kLeast, kMost)));
        },
        [&](int) { control.throw_if_cancelled(); });
    for (std::size_t i = 1; i < chosen.size(); ++i)
      if (found[i]) differences.push_back({ref, chosen[i], *found[i]});
  }
  return exposures_of(light_field.num_views(), differences);
}

bool differ(const std::vector<Exposure>& exposures) {
  constexpr float kNoticed = 0.06f;
  for (int c = 0; c < 3; ++c) {
    float least = 0, most = 0;
    for (const Exposure& exposure : exposures) {
      least = std::min(least, exposure[c]);
      most = std::max(most, exposure[c]);
    }
    if (most - least > kNoticed) return true;
  }
  return false;
}

LightField evened(LightField light_field, std::vector<Exposure> exposures) {
  require_argument(light_field.pixels != nullptr, "light_field.pixels: is null");
  require_argument(exposures.size() == light_field.views.size(),
                   "exposures: one for each view is needed");
  light_field.pixels = std::make_shared<EvenedPixels>(light_field.pixels, std::move(exposures));
  return light_field;
}

}  // namespace gigaray
