// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "src/workspace.h"

namespace gigaray::testing_support {

/// The steps of a workspace with maps of the host: what a step wants goes up, what it gives comes
/// down. Maps of the host may hold some rows only.
class HostSteps {
 public:
  explicit HostSteps(std::unique_ptr<Workspace> workspace) : workspace_(std::move(workspace)) {}
  Workspace& workspace() { return *workspace_; }

  void begin_level(const LevelShape& shape) {
    shape_ = shape;
    workspace_->begin_level(shape, 0);
  }
  void load_band(RowRange rows, const std::vector<int>& views,
                 const std::vector<std::uint8_t>& data, BandEncoding encoding,
                 const std::uint8_t* mask = nullptr) {
    EncodedRows source;
    source.encoding = encoding;
    source.pixels = up(std::span(data), rows.begin, int(views.size()));
    source.at = all_views(int(views.size()));
    if (mask) {
      const std::size_t pixels = std::size_t(rows.size()) * views.size() * shape_.width;
      source.shown = {up(std::span(mask, pixels), rows.begin, int(views.size())), shape_.width, 0};
    }
    workspace_->load_band(rows, rows, views, source);
  }

  /// A map of the whole view with what the host has of it.
  template <class T>
  Map<T> up(const StripMap<T>& map) {
    Map<T> all = workspace_->make_map<T>(shape_.width, shape_.rows());
    if (map.rows().size() > 0) workspace_->put(map, all);
    return all;
  }
  template <class T>
  RowsOnDevice up(std::span<const T> values, int begin, int views) {
    RowsOnDevice rows{workspace_->allocate(values.size_bytes()), begin, views};
    workspace_->write(*rows.memory, std::as_bytes(values));
    return rows;
  }
  template <class T>
  RowsOnDevice up(const std::vector<T>& values, int begin, int views) {
    return up(std::span<const T>(values), begin, views);
  }
  template <class T>
  void down(const RowsOnDevice& rows, std::vector<T>& values) {
    workspace_->read(*rows.memory, std::as_writable_bytes(std::span(values)));
  }
  /// Some rows of a map.
  template <class T>
  void down(const Map<T>& map, RowRange rows, StripMap<T>& out) {
    const StripMap<T> all = workspace_->get(map);
    for (int v = rows.begin; v < rows.end; ++v) std::copy_n(all.row(v), all.width(), out.row(v));
  }
  template <class T>
  Map<T> strip(RowRange rows) {
    return workspace_->make_map<T>(shape_.width, rows);
  }

  void edge_confidence(int ref, RowRange rows, StripMap<float>& confidence) {
    const auto edges = strip<float>(rows);
    workspace_->edge_confidence(ref, rows, edges);
    down(edges, rows, confidence);
  }
  void density_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                     const StripMap<HypothesisBounds>& bounds) {
    workspace_->hold_scores(0, {});  // what it has goes
    workspace_->hold_scores(0, rows);
    workspace_->density_score(ref, rows, up(todo), up(bounds));
  }
  void robust_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                    const StripMap<HypothesisBounds>& bounds, ScoreViews views) {
    workspace_->hold_scores(0, {});  // what it has goes
    workspace_->hold_scores(0, rows);
    workspace_->robust_score(ref, rows, up(todo), up(bounds), views);
  }
  /// means: row v · channels + c holds channel c of row v.
  void ray_mean(int ref, RowRange rows, const StripMap<float>& disparity, StripMap<float>& means) {
    means_ = workspace_->make_map<float>(shape_.width, {0, shape_.height * channels()});
    StripMap<std::uint8_t> wanted(shape_.width, rows);
    for (int v = rows.begin; v < rows.end; ++v) std::fill_n(wanted.row(v), shape_.width, 1);
    workspace_->ray_mean(ref, rows, up(wanted), up(disparity), means_);
    down(means_, {rows.begin * channels(), rows.end * channels()}, means);
  }
  void replace_reference(const StripMap<float>& means) {
    means_ = workspace_->make_map<float>(shape_.width, {0, shape_.height * channels()});
    workspace_->put(means, means_);
    workspace_->mean_gradients({means.rows().begin / channels(), means.rows().end / channels()},
                               means_);
    workspace_->replace_reference(means_);
  }
  void restore_reference() { workspace_->restore_reference(); }
  int channels() const { return workspace_->channels(); }
  void score_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                     const StripMap<HypothesisBounds>& bounds) {
    workspace_->score_support(ref, rows, up(todo), up(bounds));
  }
  void slanted_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                       const StripMap<HypothesisBounds>& bounds, const StripMap<Slope>& slopes) {
    workspace_->slanted_support(ref, rows, up(todo), up(bounds), up(slopes));
  }
  void scanline(int ref, RowRange rows, const StripMap<std::uint8_t>& todo) {
    workspace_->scanline(ref, rows, up(todo));
  }
  void slope_fit(int ref, RowRange rows, const StripMap<float>& in, StripMap<Slope>& slopes) {
    StripMap<std::uint8_t> todo(shape_.width, rows);
    for (int v = rows.begin; v < rows.end; ++v) std::fill_n(todo.row(v), shape_.width, 1);
    const auto out = workspace_->make_map<Slope>(shape_.width, shape_.rows());
    workspace_->slope_fit(ref, rows, up(todo), up(in), out);
    down(out, rows, slopes);
  }
  void winner(RowRange rows, const StripMap<std::uint8_t>& todo,
              const StripMap<HypothesisBounds>& bounds, StripMap<float>& disparity,
              StripMap<float>& contrast) {
    const auto winners = strip<float>(rows), lead = strip<float>(rows);
    workspace_->winner(rows, up(todo), up(bounds), winners, lead);
    down(winners, rows, disparity);
    down(lead, rows, contrast);
  }
  void score_of_estimate(RowRange rows, const StripMap<std::uint8_t>& todo,
                         const StripMap<float>& disparity, StripMap<float>& scores) {
    const auto out = strip<float>(rows);
    workspace_->score_of_estimate(rows, up(todo), up(disparity), out);
    down(out, rows, scores);
  }
  std::vector<float> scores_at(int u, int v) { return workspace_->scores_at(u, v); }
  void bilateral_median(int ref, RowRange rows, int radius, float tolerance,
                        const StripMap<float>& in, StripMap<float>& out) {
    const auto result = workspace_->make_map<float>(shape_.width, shape_.rows());
    workspace_->bilateral_median(ref, rows, radius, tolerance, up(in), result);
    down(result, rows, out);
  }
  void side_evidence(int ref, RowRange rows, float jump, const StripMap<std::uint8_t>& todo,
                     const StripMap<float>& disparity, StripMap<float>& evidence) {
    const auto out = workspace_->make_map<float>(shape_.width, shape_.rows());
    workspace_->side_evidence(ref, rows, jump, up(todo), up(disparity), out);
    down(out, rows, evidence);
  }
  void choose_sides(int ref, RowRange rows, float jump, const StripMap<float>& disparity,
                    const StripMap<float>& confidence, const StripMap<float>& evidence,
                    StripMap<float>& chosen, StripMap<float>& chosen_confidence) {
    const auto out = workspace_->make_map<float>(shape_.width, shape_.rows());
    const auto out_confidence = workspace_->make_map<float>(shape_.width, shape_.rows());
    workspace_->choose_sides(ref, rows, jump, up(disparity), up(confidence), up(evidence), out,
                             out_confidence);
    down(out, rows, chosen);
    down(out_confidence, rows, chosen_confidence);
  }
  void find_hidden(int ref, RowRange rows, float apart, const StripMap<std::uint8_t>& todo,
                   const StripMap<float>& disparity, const StripMap<float>& confidence,
                   StripMap<std::uint8_t>& hidden) {
    const auto out = workspace_->make_map<std::uint8_t>(shape_.width, shape_.rows());
    workspace_->find_hidden(ref, rows, apart, up(todo), up(disparity), up(confidence), out);
    down(out, rows, hidden);
  }
  void find_specks(RowRange rows, float apart, const StripMap<std::uint8_t>& todo,
                   const StripMap<float>& disparity, const StripMap<std::uint8_t>& hidden,
                   StripMap<std::uint8_t>& guessed) {
    const auto out = workspace_->make_map<std::uint8_t>(shape_.width, shape_.rows());
    workspace_->find_specks(rows, apart, up(todo), up(disparity), up(hidden), out);
    down(out, rows, guessed);
  }
  void fill_hidden(RowRange rows, float apart, const StripMap<std::uint8_t>& guessed,
                   StripMap<float>& disparity, StripMap<float>& confidence) {
    const auto filled = up(disparity), sure = up(confidence);
    workspace_->fill_hidden(rows, apart, up(guessed), filled, sure);
    down(filled, rows, disparity);
    down(sure, rows, confidence);
  }
  void mean_radiance(int ref, RowRange rows, const StripMap<float>& disparity,
                     StripMap<Radiance>& radiance) {
    const auto out = up(radiance);
    workspace_->mean_radiance(ref, rows, up(disparity), out);
    down(out, rows, radiance);
  }
  /// bars: of the first `finished` active views; set before and cleared behind when `finished`.
  void propagation(int ref, RowRange rows, const StripMap<float>& disparity,
                   const StripMap<float>& confidence, const StripMap<Radiance>& radiance,
                   RowRange reached, int active_count, int finished,
                   std::vector<PackedEstimate>& estimates) {
    const RowsOnDevice all = up(estimates, reached.begin, active_count);
    const RowsOnDevice bars = up(std::vector<float>(estimates.size()), reached.begin, active_count);
    const auto accepted = up(disparity);
    if (finished > 0) workspace_->set_bars(ref, rows, accepted, reached, finished, all, bars);
    workspace_->propagation(ref, rows, accepted, up(confidence), up(radiance), reached, finished,
                            bars, all);
    if (finished > 0) workspace_->clear_bars(ref, rows, accepted, reached, finished, bars);
    down(all, estimates);
    std::vector<float> left(estimates.size());
    down(bars, left);
    bars_left = std::any_of(left.begin(), left.end(), [](float bar) { return bar != 0; });
  }
  bool bars_left = false;
  /// small: [small_rows][loaded view][3][(width + 1) / 2].
  void downsample(RowRange small_rows, int views, std::vector<float>& small) {
    const RowsOnDevice out{workspace_->allocate(small.size() * sizeof(float)), small_rows.begin,
                           views};
    workspace_->downsample(small_rows, out, 0);
    down(out, small);
  }

 private:
  std::unique_ptr<Workspace> workspace_;
  LevelShape shape_;
  Map<float> means_;
};

}  // namespace gigaray::testing_support
