// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// How a view gets its winners: up to three looks at the pixels to do, each strip by strip.
#include <algorithm>

#include "pipeline.h"

namespace gigaray {
namespace {

// A silhouette, and what is farther than it, in hypotheses: a difference that the outermost views
// see.
constexpr float kJump = 7, kFarther = 3;
// Where the nearer surface can hide a point from some views, px.
constexpr int kBesideJump = 10;
// So many views make a second scoring cheaper than a first with all of them: in bands both would be
// needed.
constexpr int kManyViews = 160;

}  // namespace

void Pipeline::grow_todo(const Map<std::uint8_t>& todo) {
  workspace_.begin_stage("select");
  const int radius = options_.support.radius;
  if (radius > 0)
    workspace_.grow_todo(shape().rows(), radius, todo, of_view_.bounds, of_view_.grown_todo,
                         of_view_.grown_bounds);
}

void Pipeline::score_view(int view) {
  scored_rows_ = {};
  // Coarser levels have too few pixels, and test too few hypotheses, for more than one look.
  const bool finest = level_ == 0, again = finest && options_.support.slanted;
  grow_todo(of_view_.todo);
  Look look{&of_view_.todo, todo_counts_};
  look.scanline = finest && options_.support.scanline;
  // Where the last look has to score anew anyway, or takes very many views, a few do for the first.
  const bool few_first = again && options_.score.gradient &&
                         (options_.score.ray_mean || int(partners_[view].size()) > kManyViews);
  if (few_first) look.views = ScoreViews::kFirst;
  score_strips(view, look);
  if (!again) return;

  smooth_disparity(view);
  fit_slopes(view);
  look.with_slopes = true;
  score_strips(view, look);
  if (few_first) {
    smooth_disparity(view);
    if (options_.score.ray_mean) {
      ray_means(view);
      see_means(true);
    }
    fit_slopes(view);
    look.views = ScoreViews::kAll;
    scored_rows_ = {};
    score_strips(view, look);
  }
  if (options_.support.half_planes) look_behind(view);
  see_means(false);
}

void Pipeline::look_behind(int view) {
  workspace_.begin_stage("select");
  Maps& maps = of_view_;
  workspace_.beside_jumps(shape().rows(), maps.smooth, kJump * float(hypotheses_.step()),
                          kBesideJump, maps.todo, maps.beside);
  Look look{&maps.beside, workspace_.count_rows(maps.beside)};
  if (count(look.counts, shape().rows()) == 0) return;
  grow_todo(maps.beside);
  look.with_slopes = true;
  look.views = ScoreViews::kHalfPlanes;
  scored_rows_ = {};
  score_strips(view, look);
}

void Pipeline::score_strips(int view, const Look& look) {
  const int strip_rows = plan_.levels[level_].strip_rows;
  for (const RowRange band : bands()) {
    if (count(look.counts, band) == 0) continue;
    load_band(view, band);
    for (int v = band.begin; v < band.end; v += strip_rows) {
      const RowRange strip{v, std::min(v + strip_rows, band.end)};
      control_.throw_if_cancelled();
      if (count(look.counts, strip) > 0) score_strip(view, strip, look);
    }
  }
}

void Pipeline::score_strip(int view, RowRange rows, const Look& look) {
  const int height = shape().height, radius = options_.support.radius;
  const Map<std::uint8_t>& todo = *look.todo;
  const RowRange supported = grown(rows, look.scanline ? kScanlineReach : 0, height);
  const RowRange scored = grown(supported, radius, height);
  if (scored != scored_rows_) {
    workspace_.begin_stage("score");
    const auto& score_todo = radius > 0 ? of_view_.grown_todo : todo;
    const auto& score_bounds = radius > 0 ? of_view_.grown_bounds : of_view_.bounds;
    if (options_.score.gradient)
      workspace_.robust_score(view, scored, score_todo, score_bounds, look.views);
    else
      workspace_.density_score(view, scored, score_todo, score_bounds);
    scored_rows_ = scored;
  }
  if (radius > 0) {
    workspace_.begin_stage("support");
    if (look.with_slopes)
      workspace_.slanted_support(view, supported, todo, of_view_.bounds, of_view_.slopes);
    else
      workspace_.score_support(view, supported, todo, of_view_.bounds);
  }
  if (look.scanline) {
    workspace_.begin_stage("scanline");
    workspace_.scanline(view, rows, todo);
  }
  workspace_.begin_stage("winner");
  const auto winners = strip<float>(0, rows), contrast = strip<float>(1, rows);
  workspace_.winner(rows, todo, of_view_.bounds, winners, contrast);
  if (look.views == ScoreViews::kHalfPlanes)
    step_back(rows, todo, winners, contrast);
  else
    take_winners(view, rows, todo, winners, contrast);
}

void Pipeline::take_winners(int view, RowRange rows, const Map<std::uint8_t>& todo,
                            const Map<float>& winners, const Map<float>& contrast) {
  Map<float> best, edges;
  if (options_.winner.min_relief > 0) {
    best = strip<float>(2, rows);
    workspace_.score_of_estimate(rows, todo, winners, best);
  }
  if (options_.winner.weigh_by_edge) {
    edges = strip<float>(3, rows);
    workspace_.edge_confidence(view, rows, edges);
  }
  workspace_.take_winners(rows, is_last_level(), todo, of_view_.bounds, winners, contrast, best,
                          edges, of_view_.disparity, of_view_.confidence);
}

void Pipeline::step_back(RowRange rows, const Map<std::uint8_t>& todo, const Map<float>& winners,
                         const Map<float>& contrast) {
  const auto best = strip<float>(2, rows), own = strip<float>(3, rows);
  workspace_.score_of_estimate(rows, todo, winners, best);
  workspace_.score_of_estimate(rows, todo, of_view_.disparity, own);
  workspace_.step_back(rows, kFarther * float(hypotheses_.step()), winners, contrast, best, own,
                       of_view_.disparity, of_view_.confidence);
}

void Pipeline::smooth_disparity(int view) {
  for (const RowRange band : bands()) {
    load_band(view, band);
    workspace_.begin_stage("median");
    workspace_.bilateral_median(view, band, options_.winner.median_radius,
                                options_.winner.median_tolerance, of_view_.disparity,
                                of_view_.smooth);
  }
}

void Pipeline::ray_means(int view) {
  for (const RowRange band : bands()) {
    load_band(view, band);
    workspace_.begin_stage("ray means");
    workspace_.ray_mean(view, band, of_view_.grown_todo, of_view_.smooth, of_view_.means);
  }
}

void Pipeline::see_means(bool see) {
  sees_means_ = see;
  if (see)
    workspace_.replace_reference(of_view_.means);
  else
    workspace_.restore_reference();
}

void Pipeline::fit_slopes(int view) {
  for (const RowRange band : bands()) {
    if (count(todo_counts_, band) == 0) continue;
    load_band(view, band);
    workspace_.begin_stage("slopes");
    workspace_.slope_fit(view, band, of_view_.todo, of_view_.smooth, of_view_.slopes);
  }
}

}  // namespace gigaray
