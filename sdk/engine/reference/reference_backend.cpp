// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "band.h"
#include "bilateral_median.h"
#include "density_score.h"
#include "downsample.h"
#include "edge_confidence.h"
#include "gigaray/samplers/any_sampler.h"
#include "mean_radiance.h"
#include "propagation.h"
#include "ray_mean.h"
#include "robust_score.h"
#include "scanline.h"
#include "score_support.h"
#include "slope_fit.h"
#include "src/band_views.h"
#include "unpack_channels.h"
#include "winner.h"

namespace gigaray {
namespace {

using namespace reference;

template <RaySampler S>
class ReferenceBackend : public Backend {
 public:
  ReferenceBackend(const S& sampler, const BackendSetup& setup)
      : level0_sampler_(sampler),
        sampler_(sampler),
        setup_(setup),
        table_(colour_table(setup.bit_depth, setup.options.score.linear_rgb)) {}

  std::string name() const override { return "reference"; }
  std::string description() const override { return "plain C++ on one thread"; }
  void set_active_views(const std::vector<int>& views) override { active_views_ = views; }

  void begin_level(const LevelShape& shape) override {
    band_ = Band{shape, {}, 0, channels(), {}};
    places_.clear();
  }
  void load_band(RowRange rows, const std::vector<int>& views, const void* encoded,
                 BandEncoding encoding, const std::uint8_t* mask) override {
    restore_reference();
    sampler_ = level0_sampler_.subset(views).at_level(band_.shape.level);
    places_ = places_in(views, level0_sampler_.num_views());
    band_.rows = rows;
    band_.num_views = int(views.size());
    band_.data.resize(std::size_t(rows.size()) * band_.num_views * band_.channels *
                      band_.shape.width);
    unpack_channels(encoded, encoding, table_, band_);
    if (mask) mask_pixels(mask, band_);
  }
  void edge_confidence(int ref, RowRange rows, StripMap<float>& confidence) override {
    reference::edge_confidence(band_, place(ref), rows, setup_.options.edge,
                               setup_.kind != LightFieldKind::k3D, confidence);
  }
  void density_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                     const StripMap<HypothesisBounds>& bounds) override {
    score_rays(rows, todo, bounds, [&, at = place(ref)](const Ray& ray) {
      return reference::density_score(band_, sampler_, at, ray, setup_.options.score);
    });
  }
  void robust_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                    const StripMap<HypothesisBounds>& bounds, ScoreViews views) override {
    const bool halves = views == ScoreViews::kHalfPlanes;
    const int at = place(ref);
    const auto members = score_members(sampler_, at, views, setup_.hypotheses);
    const OwnPixels own = reference_pixels(ref);
    const ScoreOptions score =
        own_.data.empty() ? setup_.options.score : against_means(setup_.options.score);
    score_rays(rows, todo, bounds, [&](const Ray& ray) {
      return reference::robust_score(band_, sampler_, at, ray,
                                     own.band.pixel(own.view, int(ray.u), int(ray.v)), score,
                                     members, halves ? kHalfPlanes : 1);
    });
  }
  void ray_mean(int ref, RowRange rows, const StripMap<float>& disparity,
                StripMap<float>& means) override {
    reference::ray_mean(band_, sampler_, place(ref), rows, setup_.options.score, disparity, means);
  }
  void replace_reference(RowRange rows, const StripMap<float>& means) override {
    own_ = Band{band_.shape, rows, 1, band_.channels, {}};
    own_.data.resize(std::size_t(rows.size()) * own_.channels * own_.shape.width);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int c = 0; c < 3; ++c)
        std::copy_n(means.row(v * own_.channels + c), own_.shape.width, own_.plane(0, v, c));
    unpack_gradients(own_);
  }
  void restore_reference() override { own_ = {}; }
  int channels() const override { return setup_.options.score.gradient ? 5 : 3; }
  void score_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                     const StripMap<HypothesisBounds>& bounds) override {
    const OwnPixels own = reference_pixels(ref);
    supported_scores_ = reference::score_support(own.band, own.view, rows, setup_.options.support,
                                                 todo, bounds, raw_scores_);
    winner_takes(supported_scores_);
  }
  void slanted_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                       const StripMap<HypothesisBounds>& bounds,
                       const StripMap<Slope>& slopes) override {
    const OwnPixels own = reference_pixels(ref);
    supported_scores_ =
        reference::slanted_support(own.band, own.view, rows, setup_.options.support,
                                   setup_.hypotheses, todo, bounds, slopes, raw_scores_);
    winner_takes(supported_scores_);
  }
  void scanline(int ref, RowRange rows, const StripMap<std::uint8_t>& todo) override {
    const OwnPixels own = reference_pixels(ref);
    path_scores_ = reference::scanline(own.band, own.view, rows, setup_.options.support, todo,
                                       supported_scores_);
    chosen_by_ = &path_scores_;
  }
  void slope_fit(int ref, RowRange rows, const StripMap<float>& in,
                 StripMap<Slope>& slopes) override {
    const OwnPixels own = reference_pixels(ref);
    const float step = float(setup_.hypotheses.step());
    reference::slope_fit(own.band, own.view, rows, step, step * setup_.options.support.max_slope,
                         in, slopes);
  }
  void winner(RowRange rows, const StripMap<std::uint8_t>& todo,
              const StripMap<HypothesisBounds>& bounds, StripMap<float>& disparity,
              StripMap<float>& contrast) override {
    reference::winner(rows, *chosen_by_, *winner_scores_,
                      chosen_by_ == winner_scores_ ? 0 : kScanlineSearch, setup_.hypotheses,
                      setup_.options.winner.refine, todo, bounds, disparity, contrast);
  }
  void score_of_estimate(RowRange rows, const StripMap<std::uint8_t>& todo,
                         const StripMap<float>& disparity, StripMap<float>& scores) override {
    reference::score_of_estimate(rows, *winner_scores_, setup_.hypotheses, todo, disparity, scores);
  }
  std::vector<float> scores_at(int u, int v) override {
    std::vector<float> scores;
    for (int i = 0; i < winner_scores_->count; ++i) scores.push_back(winner_scores_->at(u, v, i));
    return scores;
  }
  void bilateral_median(int ref, RowRange rows, int radius, float tolerance,
                        const StripMap<float>& in, StripMap<float>& out) override {
    const OwnPixels own = reference_pixels(ref);
    reference::bilateral_median(own.band, own.view, rows, radius, tolerance, in, out);
  }
  void mean_radiance(int ref, RowRange rows, const StripMap<float>& disparity,
                     StripMap<Radiance>& radiance) override {
    reference::mean_radiance(band_, sampler_, place(ref), rows, setup_.options.score, disparity,
                             radiance);
  }
  void propagation(int ref, RowRange rows, const StripMap<float>& disparity,
                   const StripMap<float>& confidence, const StripMap<Radiance>& radiance,
                   RowRange state_rows, const float* bars, PackedEstimate* estimates) override {
    std::vector<int> active;
    for (const int view : active_views_) active.push_back(places_[view]);
    reference::propagation(band_, sampler_, place(ref), rows, active, setup_.options.propagation,
                           disparity, confidence, radiance, state_rows, bars, estimates);
  }
  void downsample(RowRange small_rows, float* small) override {
    reference::downsample(band_, small_rows, small);
  }

 private:
  int place(int view) const { return place_of(places_, view); }
  /// Where the pixels of the reference view are.
  struct OwnPixels {
    const Band& band;
    int view;
  };
  OwnPixels reference_pixels(int ref) const {
    return own_.data.empty() ? OwnPixels{band_, place(ref)} : OwnPixels{own_, 0};
  }
  template <class ScoreOf>
  void score_rays(RowRange rows, const StripMap<std::uint8_t>& todo,
                  const StripMap<HypothesisBounds>& bounds, ScoreOf score_of) {
    raw_scores_ = Scores(rows, setup_.hypotheses.count, band_.shape.width);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < band_.shape.width; ++u) {
        if (!todo.row(v)[u]) continue;
        const auto [first, last] = bounds.row(v)[u];
        for (int i = first; i <= last; ++i)
          raw_scores_.at(u, v, i) = score_of(Ray{double(u), double(v), setup_.hypotheses.value(i)});
        raw_scores_.repeat_ends(u, v, bounds.row(v)[u]);
      }
    winner_takes(raw_scores_);
  }
  void winner_takes(const Scores& scores) { chosen_by_ = winner_scores_ = &scores; }

  S level0_sampler_;
  S sampler_;
  BackendSetup setup_;
  std::vector<float> table_;
  std::vector<int> active_views_;
  std::vector<int> places_;  ///< of the views in band_
  Band band_;
  Band own_;  ///< replaced pixels of the reference view; empty: those of band_
  Scores raw_scores_, supported_scores_, path_scores_;
  const Scores* winner_scores_ = nullptr;
  const Scores* chosen_by_ = nullptr;  ///< path_scores_ after a scan-line step, else the scores
};

}  // namespace

template <RaySampler S>
std::unique_ptr<Backend> make_reference_backend(const S& sampler, const BackendSetup& setup) {
  return std::make_unique<ReferenceBackend<S>>(sampler, setup);
}

template std::unique_ptr<Backend> make_reference_backend(const EpiSampler&, const BackendSetup&);
template std::unique_ptr<Backend> make_reference_backend(const GridSampler&, const BackendSetup&);
template std::unique_ptr<Backend> make_reference_backend(const UnstructuredSampler&,
                                                         const BackendSetup&);

}  // namespace gigaray
