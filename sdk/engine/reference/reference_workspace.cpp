// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "band.h"
#include "bilateral_median.h"
#include "density_score.h"
#include "downsample.h"
#include "edge_confidence.h"
#include "estimates.h"
#include "gigaray/samplers/any_sampler.h"
#include "hidden.h"
#include "masks.h"
#include "mean_radiance.h"
#include "propagation.h"
#include "ray_mean.h"
#include "robust_score.h"
#include "scanline.h"
#include "score_support.h"
#include "search_bounds.h"
#include "slope_fit.h"
#include "src/band_ring.h"
#include "src/band_views.h"
#include "src/make_workspace.h"
#include "src/row_store.h"
#include "unpack_channels.h"
#include "winner.h"

namespace gigaray {
namespace {

using namespace reference;

/// The host's memory, owned or adopted.
class HostMemory : public Memory {
 public:
  explicit HostMemory(std::size_t bytes) : Memory(bytes), own_(bytes), data_(own_.data()) {
    std::memset(data_, 0, bytes);
  }
  explicit HostMemory(std::span<std::byte> adopted)
      : Memory(adopted.size()), data_(adopted.data()) {}
  std::byte* data() const { return data_; }

 private:
  AlignedBytes own_;
  std::byte* data_;
};

std::byte* bytes_of(const Memory& memory) { return static_cast<const HostMemory&>(memory).data(); }

template <class T>
MapView<T> view(const Map<T>& map) {
  return {reinterpret_cast<T*>(bytes_of(map.memory())), map.width(), map.rows()};
}
template <class T>
StripMap<T> copied(const Map<T>& map) {
  StripMap<T> copy(map.width(), map.rows());
  std::memcpy(copy.view().padded_row(map.rows().begin), bytes_of(map.memory()),
              std::size_t(copy.pitch()) * map.rows().size() * sizeof(T));
  return copy;
}
template <class T>
void copy_rows(const StripMap<T>& from, RowRange rows, const Map<T>& to) {
  for (int v = rows.begin; v < rows.end; ++v) std::copy_n(from.row(v), to.width(), view(to).row(v));
}

template <RaySampler S>
class ReferenceWorkspace : public Workspace {
 public:
  ReferenceWorkspace(const S& sampler, const WorkspaceSetup& setup)
      : level0_sampler_(sampler),
        sampler_(sampler),
        setup_(setup),
        table_(colour_table(setup.bit_depth, setup.options.score.linear_rgb)) {}

  std::string name() const override { return "reference"; }
  std::string description() const override { return "plain C++ on one thread"; }

  std::shared_ptr<Memory> allocate(std::size_t bytes) override {
    return std::make_shared<HostMemory>(bytes);
  }
  std::shared_ptr<Memory> adopt(std::span<std::byte> host) override {
    return std::make_shared<HostMemory>(host);
  }
  void write(Memory& memory, std::span<const std::byte> data, std::size_t offset) override {
    std::memcpy(bytes_of(memory) + offset, data.data(), data.size());
  }
  void read(const Memory& memory, std::span<std::byte> data, std::size_t offset) override {
    std::memcpy(data.data(), bytes_of(memory) + offset, data.size());
  }
  void read_later(const Memory& memory, std::span<std::byte> data, std::size_t offset) override {
    read(memory, data, offset);
  }
  std::span<std::byte> map(Memory& memory, bool) override {
    return {bytes_of(memory), memory.bytes()};
  }
  void unmap(Memory&, std::span<std::byte>) override {}
  void finish() override {}
  void keep_pace() override {}
  bool shares_host_memory() const override { return true; }
  const Traffic& traffic() const override { return traffic_; }
  void begin_stage(const std::string& stage) override {
    const auto now = std::chrono::steady_clock::now();
    if (stage_) *stage_ += std::chrono::duration<double>(now - stage_begin_).count();
    stage_ = stage.empty() ? nullptr : &seconds_[stage];
    stage_begin_ = now;
  }
  const std::map<std::string, double>& seconds() const override { return seconds_; }

  void set_active_views(const std::vector<int>& views) override { active_views_ = views; }
  void begin_level(const LevelShape& shape, int band_rows) override {
    ring_ = {{}, band_rows};
    loaded_views_.clear();
    band_ = Band{shape, {}, 0, channels(), {}};
    places_.clear();
    active_places_.clear();
    volumes_ = {};
  }
  RowRange missing_rows(RowRange rows, const std::vector<int>& views) const override {
    return views == loaded_views_ ? ring_.missing(rows) : rows;
  }
  void load_band(RowRange rows, RowRange fresh, const std::vector<int>& views,
                 const EncodedRows& source) override {
    restore_reference();
    loaded_views_ = views;
    sampler_ = level0_sampler_.subset(views).at_level(band_.shape.level);
    places_ = places_in(views, level0_sampler_.num_views());
    active_places_.clear();
    for (const int active : active_views_) active_places_.push_back(places_[active]);
    const RowRange want_gradients = ring_.load(rows, fresh);
    const std::size_t row = std::size_t(views.size()) * band_.channels * band_.shape.width;
    if (ring_.rows.begin > band_.rows.begin && fresh != rows)
      band_.data.erase(band_.data.begin(),
                       band_.data.begin() + (ring_.rows.begin - band_.rows.begin) * row);
    band_.rows = ring_.rows;
    band_.num_views = int(views.size());
    band_.data.resize(band_.rows.size() * row);
    const std::size_t line = band_.shape.width * pixel_bytes(source.encoding);
    std::vector<std::byte> encoded(std::size_t(fresh.size()) * views.size() * line);
    std::byte* out = encoded.data();
    for (int v = fresh.begin; v < fresh.end; ++v)
      for (const int at : source.at) {
        const std::size_t from =
            std::size_t(v - source.pixels.begin) * source.pixels.stored_views + at;
        std::memcpy(out, bytes_of(*source.pixels.memory) + from * line, line);
        out += line;
      }
    unpack_colours(encoded.data(), source.encoding, table_, fresh, band_);
    unpack_gradients(want_gradients, band_);
    if (!source.shown.rows) return;
    std::vector<std::uint8_t> mask;
    for (int v = fresh.begin; v < fresh.end; ++v)
      for (const int at : source.at)
        for (int u = 0; u < band_.shape.width; ++u) mask.push_back(shows(source.shown, at, u, v));
    mask_pixels(mask.data(), fresh, band_);
  }
  void downsample(RowRange small_rows, const RowsOnDevice& small, int first) override {
    const std::size_t line = std::size_t((band_.shape.width + 1) / 2) * 3;
    std::vector<float> values(std::size_t(small_rows.size()) * band_.num_views * line);
    reference::downsample(band_, small_rows, values.data());
    auto* out = reinterpret_cast<float*>(bytes_of(*small.memory));
    for (int v = small_rows.begin; v < small_rows.end; ++v)
      std::copy_n(values.data() + std::size_t(v - small_rows.begin) * band_.num_views * line,
                  band_.num_views * line,
                  out + (std::size_t(v - small.begin) * small.stored_views + first) * line);
  }
  int channels() const override { return setup_.options.score.gradient ? 5 : 3; }
  void ray_mean(int ref, RowRange rows, const Map<std::uint8_t>& wanted,
                const Map<float>& disparity, const Map<float>& means) override {
    StripMap<float> rays = copied(disparity);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < rays.width(); ++u)
        if (!view(wanted).row(v)[u]) rays.row(v)[u] = kNoEstimate;
    reference::ray_mean(band_, sampler_, place(ref), rows, setup_.options.score, rays.view(),
                        view(means));
  }
  void mean_gradients(RowRange rows, const Map<float>& means) override {
    if (channels() < 5) return;
    const Band band = band_of(means);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int c = 3; c < channels(); ++c)
        std::copy_n(band.plane(0, v, c), band.shape.width, view(means).row(v * channels() + c));
  }
  void replace_reference(const Map<float>& means) override { own_ = band_of(means); }
  void restore_reference() override { own_ = {}; }

  void edge_confidence(int ref, RowRange rows, const Map<float>& strip) override {
    reference::edge_confidence(band_, place(ref), rows, setup_.options.edge,
                               setup_.kind != LightFieldKind::k3D, view(strip));
  }
  void edge_mask(RowRange rows, const Map<float>& strip, float threshold,
                 const Map<std::uint8_t>& mask) override {
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < strip.width(); ++u)
        view(mask).row(v)[u] = view(strip).row(v)[u] > threshold;
  }
  void erode(RowRange rows, const Map<std::uint8_t>& in, const Map<std::uint8_t>& out) override {
    gigaray::erode(rows, band_.shape.height, view(in), view(out));
  }
  void dilate(RowRange rows, const Map<std::uint8_t>& in, const Map<std::uint8_t>& out) override {
    gigaray::dilate(rows, band_.shape.height, view(in), view(out));
  }
  void put_mask(RowRange rows, const Map<std::uint8_t>& mask, const ViewRows& to) override {
    for (int v = rows.begin; v < rows.end; ++v)
      std::copy_n(view(mask).row(v), mask.width(), &rows_of<std::uint8_t>(to.rows).at(v, to.at, 0));
  }
  void unpack_estimates(RowRange rows, const ViewRows& estimates, const Map<float>& disparity,
                        const Map<float>& confidence) override {
    const auto all = rows_of<PackedEstimate>(estimates.rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < disparity.width(); ++u) {
        view(disparity).row(v)[u] = hypothesis_of(all.at(v, estimates.at, u));
        view(confidence).row(v)[u] = confidence_of(all.at(v, estimates.at, u));
      }
  }
  void close_cracks(RowRange rows, int width, float apart, const Map<float>& disparity,
                    const Map<float>& confidence, const Map<float>& closed,
                    const Map<float>& closed_confidence, const ViewRows& estimates) override {
    StripMap<float> h = copied(disparity), c = copied(confidence);
    const StripMap<std::uint8_t> filled = gigaray::close_cracks(width, apart, h, c);
    copy_rows(h, rows, closed);
    copy_rows(c, rows, closed_confidence);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < h.width(); ++u)
        if (filled.row(v)[u])
          rows_of<PackedEstimate>(estimates.rows).at(v, estimates.at, u) =
              pack_estimate(h.row(v)[u], c.row(v)[u]);
  }
  void select_todo(RowRange rows, const Map<float>& disparity, const ViewRows& mask,
                   const ShownRows& shown, int shown_at, const ViewRows& search,
                   const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds) override {
    const HypothesisBounds full{0, std::uint16_t(setup_.hypotheses.count - 1)};
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < disparity.width(); ++u) {
        view(todo).row(v)[u] = 0;
        view(bounds).row(v)[u] = {};
        if (!std::isnan(view(disparity).row(v)[u])) continue;
        if (mask && !rows_of<std::uint8_t>(mask.rows).at(v, mask.at, u)) continue;
        if (shown.rows && !shows(shown, shown_at, u, v)) continue;
        HypothesisBounds wanted = full;
        if (search) {
          const Search& known = rows_of<Search>(search.rows).at(v, search.at, u);
          if (std::isnan(known.low)) continue;
          wanted = bounds_of(known, setup_.hypotheses);
        }
        view(todo).row(v)[u] = 1;
        view(bounds).row(v)[u] = wanted;
      }
  }
  void bound_thin_holes(RowRange rows, const Map<std::uint8_t>& todo, const Map<std::uint8_t>& wide,
                        const Map<float>& estimates, const Map<HypothesisBounds>& bounds) override {
    gigaray::bound_thin_holes(rows, view(todo), view(wide), view(estimates), setup_.hypotheses,
                              view(bounds));
  }
  void grow_todo(RowRange rows, int radius, const Map<std::uint8_t>& todo,
                 const Map<HypothesisBounds>& bounds, const Map<std::uint8_t>& grown_todo,
                 const Map<HypothesisBounds>& grown_bounds) override {
    StripMap<std::uint8_t> t = copied(todo);
    StripMap<HypothesisBounds> b = copied(bounds);
    gigaray::grow_todo(radius, band_.shape.height, t, b);
    copy_rows(t, rows, grown_todo);
    copy_rows(b, rows, grown_bounds);
  }
  void beside_jumps(RowRange rows, const Map<float>& map, float jump, int reach,
                    const Map<std::uint8_t>& todo, const Map<std::uint8_t>& beside) override {
    StripMap<std::uint8_t> near = gigaray::beside_jumps(copied(map), jump, reach);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < near.width(); ++u)
        view(beside).row(v)[u] = near.row(v)[u] && view(todo).row(v)[u];
  }
  std::vector<int> count_estimates(const Map<float>& estimates) override {
    std::vector<int> counts;
    for (int v = 0; v < band_.shape.height; ++v)
      counts.push_back(
          int(std::count_if(view(estimates).row(v), view(estimates).row(v) + estimates.width(),
                            [](float h) { return !std::isnan(h); })));
    return counts;
  }
  std::vector<int> count_rows(const Map<std::uint8_t>& mask) override {
    std::vector<int> counts;
    for (int v = 0; v < band_.shape.height; ++v)
      counts.push_back(mask.width() -
                       int(std::count(view(mask).row(v), view(mask).row(v) + mask.width(), 0)));
    return counts;
  }

  void hold_scores(int volume, RowRange rows) override {
    Scores held(rows, setup_.hypotheses.count, band_.shape.width);
    const Scores& before = volumes_[volume];
    const std::size_t row = std::size_t(held.count) * held.width;
    for (int v = std::max(rows.begin, before.rows.begin); v < std::min(rows.end, before.rows.end);
         ++v)
      std::copy_n(before.data.begin() + std::size_t(v - before.rows.begin) * row, row,
                  held.data.begin() + std::size_t(v - rows.begin) * row);
    volumes_[volume] = std::move(held);
    raw_ = &volumes_[volume];
    winner_takes(*raw_);
  }
  void density_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                     const Map<HypothesisBounds>& bounds) override {
    score_rays(rows, todo, bounds, [&, at = place(ref)](const Ray& ray) {
      return reference::density_score(band_, sampler_, at, ray, setup_.options.score);
    });
  }
  void robust_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                    const Map<HypothesisBounds>& bounds, ScoreViews views) override {
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
  void score_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                     const Map<HypothesisBounds>& bounds) override {
    const OwnPixels own = reference_pixels(ref);
    supported_scores_ = reference::score_support(own.band, own.view, rows, setup_.options.support,
                                                 view(todo), view(bounds), *raw_);
    winner_takes(supported_scores_);
  }
  void slanted_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                       const Map<HypothesisBounds>& bounds, const Map<Slope>& slopes) override {
    const OwnPixels own = reference_pixels(ref);
    supported_scores_ = reference::slanted_support(own.band, own.view, rows, setup_.options.support,
                                                   setup_.hypotheses, view(todo), view(bounds),
                                                   view(slopes), *raw_);
    winner_takes(supported_scores_);
  }
  void scanline(int ref, RowRange rows, const Map<std::uint8_t>& todo) override {
    const OwnPixels own = reference_pixels(ref);
    path_scores_ = reference::scanline(own.band, own.view, rows, setup_.options.support, view(todo),
                                       supported_scores_);
    chosen_by_ = &path_scores_;
  }
  std::vector<float> scores_at(int u, int v) override {
    std::vector<float> scores;
    for (int i = 0; i < winner_scores_->count; ++i) scores.push_back(winner_scores_->at(u, v, i));
    return scores;
  }

  void winner(RowRange rows, const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds,
              const Map<float>& disparity, const Map<float>& contrast) override {
    reference::winner(rows, *chosen_by_, *winner_scores_,
                      chosen_by_ == winner_scores_ ? 0 : kScanlineSearch, setup_.hypotheses,
                      setup_.options.winner, view(todo), view(bounds), view(disparity),
                      view(contrast));
  }
  void score_of_estimate(RowRange rows, const Map<std::uint8_t>& todo, const Map<float>& disparity,
                         const Map<float>& scores) override {
    reference::score_of_estimate(rows, *winner_scores_, setup_.hypotheses, view(todo),
                                 view(disparity), view(scores));
  }
  void take_winners(RowRange rows, bool is_last_level, const Map<std::uint8_t>& todo,
                    const Map<HypothesisBounds>& bounds, const Map<float>& winners,
                    const Map<float>& contrast, const Map<float>& best, const Map<float>& edges,
                    const Map<float>& disparity, const Map<float>& confidence) override {
    Winners found{view(winners), view(contrast)};
    MapView<const float> best_view, edge_view;
    if (best) found.best = &(best_view = view(best));
    if (edges) found.edges = &(edge_view = view(edges));
    reference::take_winners(rows, setup_.hypotheses, setup_.options.winner.min_relief,
                            is_last_level, view(todo), view(bounds), found, view(disparity),
                            view(confidence));
  }
  void step_back(RowRange rows, float farther, const Map<float>& winners,
                 const Map<float>& contrast, const Map<float>& best, const Map<float>& own,
                 const Map<float>& disparity, const Map<float>& confidence) override {
    reference::step_back(rows, farther, kStepBackLead, view(winners), view(contrast), view(best),
                         view(own), view(disparity), view(confidence));
  }
  void side_evidence(int ref, RowRange rows, float jump, const Map<std::uint8_t>& todo,
                     const Map<float>& disparity, const Map<float>& evidence) override {
    const OwnPixels own = reference_pixels(ref);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < disparity.width(); ++u) {
        float& answer = view(evidence).row(v)[u];
        answer = kNoEstimate;
        if (!view(todo).row(v)[u]) continue;
        const auto sides = reference::sides_at(view(disparity), band_.shape.height, u, v, jump);
        if (std::isnan(sides.near) || std::isnan(sides.far)) continue;
        answer = reference::side_evidence(band_, sampler_, place(ref), u, v, sides,
                                          setup_.hypotheses, view(disparity),
                                          own.band.pixel(own.view, u, v), setup_.options.score);
      }
  }
  void choose_sides(int ref, RowRange rows, float jump, const Map<float>& disparity,
                    const Map<float>& confidence, const Map<float>& evidence,
                    const Map<float>& chosen, const Map<float>& chosen_confidence) override {
    const OwnPixels own = reference_pixels(ref);
    reference::choose_sides(own.band, own.view, rows, jump, setup_.options.support.sigma_colour,
                            view(disparity), view(confidence), view(evidence), view(chosen),
                            view(chosen_confidence));
  }
  void find_hidden(int ref, RowRange rows, float apart, const Map<std::uint8_t>& todo,
                   const Map<float>& disparity, const Map<float>& confidence,
                   const Map<std::uint8_t>& hidden) override {
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < disparity.width(); ++u)
        view(hidden).row(v)[u] =
            view(todo).row(v)[u] && !std::isnan(view(disparity).row(v)[u]) &&
            reference::is_hidden(sampler_, place(ref), u, v, band_.shape.height, setup_.hypotheses,
                                 apart, view(disparity), view(confidence));
  }
  void find_specks(RowRange rows, float apart, const Map<std::uint8_t>& todo,
                   const Map<float>& disparity, const Map<std::uint8_t>& hidden,
                   const Map<std::uint8_t>& guessed) override {
    reference::find_specks(rows, band_.shape.height, apart, view(todo), view(disparity),
                           view(hidden), view(guessed));
  }
  void fill_hidden(RowRange rows, float apart, const Map<std::uint8_t>& guessed,
                   const Map<float>& disparity, const Map<float>& confidence) override {
    reference::fill_hidden(rows, apart, view(guessed), view(disparity), view(confidence));
  }
  void bilateral_median(int ref, RowRange rows, int radius, float tolerance, const Map<float>& in,
                        const Map<float>& out) override {
    const OwnPixels own = std::isfinite(tolerance) ? reference_pixels(ref) : OwnPixels{band_, 0};
    reference::bilateral_median(own.band, own.view, rows, radius, tolerance, view(in), view(out));
  }
  void slope_fit(int ref, RowRange rows, const Map<std::uint8_t>& todo, const Map<float>& in,
                 const Map<Slope>& slopes) override {
    const OwnPixels own = reference_pixels(ref);
    const float step = float(setup_.hypotheses.step());
    reference::slope_fit(own.band, own.view, rows, step, step * setup_.options.support.max_slope,
                         view(todo), view(in), view(slopes));
  }
  void accept(RowRange rows, float threshold, const Map<std::uint8_t>& todo,
              const Map<float>& confidence, const Map<float>& estimates) override {
    reference::accept(rows, threshold, view(todo), view(confidence), view(estimates));
  }
  void mean_radiance(int ref, RowRange rows, const Map<float>& disparity,
                     const Map<Radiance>& radiance) override {
    reference::mean_radiance(band_, sampler_, place(ref), rows, setup_.options.score,
                             view(disparity), view(radiance));
  }
  int compact_tuples(int of_view, RowRange rows, const Map<float>& disparity,
                     const Map<float>& confidence, const Map<Radiance>& radiance,
                     Memory& tuples) override {
    const std::vector<RayTuple> all = reference::compact_tuples(
        of_view, band_.shape.level, rows, view(disparity), view(confidence), view(radiance));
    GIGARAY_CHECK(all.size() * sizeof(RayTuple) <= tuples.bytes());
    std::memcpy(bytes_of(tuples), all.data(), all.size() * sizeof(RayTuple));
    return int(all.size());
  }

  void set_bars(int ref, RowRange rows, const Map<float>& disparity, RowRange reached, int finished,
                const RowsOnDevice& estimates, const RowsOnDevice& bars) override {
    reference::set_bars(sampler_, place(ref), rows, active_places_, view(disparity),
                        band_.shape.height, reached, finished,
                        setup_.options.propagation.finished_lead,
                        rows_of<PackedEstimate>(estimates), rows_of<float>(bars));
  }
  void propagation(int ref, RowRange rows, const Map<float>& disparity,
                   const Map<float>& confidence, const Map<Radiance>& radiance, RowRange reached,
                   int finished, const RowsOnDevice& bars, const RowsOnDevice& estimates) override {
    reference::propagation(band_, sampler_, place(ref), rows, active_places_,
                           setup_.options.propagation, view(disparity), view(confidence),
                           view(radiance), reached, finished, rows_of<float>(bars),
                           rows_of<PackedEstimate>(estimates));
  }
  void clear_bars(int ref, RowRange rows, const Map<float>& disparity, RowRange reached,
                  int finished, const RowsOnDevice& bars) override {
    reference::clear_bars(sampler_, place(ref), rows, active_places_, view(disparity),
                          band_.shape.height, reached, finished, rows_of<float>(bars));
  }
  void coarsen_bounds(RowRange rows, const ViewRows& estimates, const ViewRows& search,
                      const ViewRows& coarse) override {
    const int width = band_.shape.width, small = (width + 1) / 2;
    const auto fine = rows_of<PackedEstimate>(estimates.rows);
    const auto finer = rows_of<Search>(search.rows);
    auto out = rows_of<Search>(coarse.rows);
    out.width = small;
    for (int v = rows.begin; v < rows.end; ++v) {
      std::vector<PackedEstimate> own;
      std::vector<Search> known;
      for (int y = 2 * v; y < std::min(2 * v + 2, band_.shape.height); ++y) {
        own.insert(own.end(), &fine.at(y, estimates.at, 0), &fine.at(y, estimates.at, 0) + width);
        if (search)
          known.insert(known.end(), &finer.at(y, search.at, 0), &finer.at(y, search.at, 0) + width);
      }
      gigaray::coarsen_bounds(own, known, width, setup_.hypotheses,
                              std::span(&out.at(v, coarse.at, 0), std::size_t(small)));
    }
  }
  void fill_view(RowRange rows, const LevelShape& shape, const ViewRows& estimates,
                 const ViewMaps& coarse, const ShownRows& shown, int shown_at,
                 const ViewMaps& maps) override {
    auto own = rows_of<PackedEstimate>(estimates.rows);
    own.width = shape.width;
    FilledMaps above;
    if (coarse.disparity)
      above = {view(coarse.disparity), view(coarse.confidence), view(coarse.level)};
    reference::fill_view(rows, shape.level, estimates.at, own, coarse.disparity ? &above : nullptr,
                         {view(maps.disparity), view(maps.confidence), view(maps.level)});
    if (!shown.rows) return;
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < shape.width; ++u) {
        if (shows(shown, shown_at, u, v)) continue;
        view(maps.disparity).row(v)[u] = view(maps.confidence).row(v)[u] = kNoEstimate;
        view(maps.level).row(v)[u] = -1;
      }
  }

 private:
  int place(int view_idx) const { return place_of(places_, view_idx); }
  template <class T>
  StoredRows<T> rows_of(const RowsOnDevice& rows) const {
    if (!rows) return {};
    return {reinterpret_cast<T*>(bytes_of(*rows.memory)), rows.begin, rows.stored_views,
            band_.shape.width};
  }
  static std::uint8_t shows(const ShownRows& shown, int at, int u, int v) {
    const std::size_t line =
        std::size_t((v << shown.shift) - shown.rows.begin) * shown.rows.stored_views + at;
    return std::uint8_t(
        bytes_of(*shown.rows.memory)[line * shown.width + (std::size_t(u) << shown.shift)]);
  }
  /// Means with their gradients, as a band of one view.
  Band band_of(const Map<float>& means) const {
    Band band{band_.shape, band_.shape.rows(), 1, band_.channels, {}};
    band.data.resize(std::size_t(band.rows.size()) * band.channels * band.shape.width);
    for (int v = 0; v < band.rows.end; ++v)
      for (int c = 0; c < 3; ++c)
        std::copy_n(view(means).row(v * band.channels + c), band.shape.width, band.plane(0, v, c));
    unpack_gradients(band.rows, band);
    return band;
  }
  /// Where the pixels of the reference view are.
  struct OwnPixels {
    const Band& band;
    int view;
  };
  OwnPixels reference_pixels(int ref) const {
    return own_.data.empty() ? OwnPixels{band_, place(ref)} : OwnPixels{own_, 0};
  }
  template <class ScoreOf>
  void score_rays(RowRange rows, const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds,
                  ScoreOf score_of) {
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < band_.shape.width; ++u) {
        if (!view(todo).row(v)[u]) continue;
        const auto [first, last] = view(bounds).row(v)[u];
        for (int i = first; i <= last; ++i)
          raw_->at(u, v, i) = score_of(Ray{double(u), double(v), setup_.hypotheses.value(i)});
        raw_->repeat_ends(u, v, view(bounds).row(v)[u]);
      }
    winner_takes(*raw_);
  }
  void winner_takes(const Scores& scores) { chosen_by_ = winner_scores_ = &scores; }

  S level0_sampler_;
  S sampler_;
  WorkspaceSetup setup_;
  std::vector<float> table_;
  std::vector<int> active_views_;
  std::vector<int> places_;         ///< of the views in band_
  std::vector<int> active_places_;  ///< the same, of the active views
  std::vector<int> loaded_views_;
  BandRing ring_;
  Band band_;
  Band own_;  ///< replaced pixels of the reference view; empty: those of band_
  std::array<Scores, 3> volumes_;
  Scores* raw_ = volumes_.data();  ///< that steps work on
  Scores supported_scores_, path_scores_;
  const Scores* winner_scores_ = nullptr;
  const Scores* chosen_by_ = nullptr;  ///< path_scores_ after a scan-line step, else the scores
  Traffic traffic_;                    ///< none: all memory is the host's
  std::map<std::string, double> seconds_;
  double* stage_ = nullptr;
  std::chrono::steady_clock::time_point stage_begin_;
};

}  // namespace

template <RaySampler S>
std::unique_ptr<Workspace> make_reference_workspace(const S& sampler, const WorkspaceSetup& setup) {
  return std::make_unique<ReferenceWorkspace<S>>(sampler, setup);
}

template std::unique_ptr<Workspace> make_reference_workspace(const EpiSampler&,
                                                             const WorkspaceSetup&);
template std::unique_ptr<Workspace> make_reference_workspace(const GridSampler&,
                                                             const WorkspaceSetup&);
template std::unique_ptr<Workspace> make_reference_workspace(const UnstructuredSampler&,
                                                             const WorkspaceSetup&);

}  // namespace gigaray
