// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// How a view gets its winners: up to three looks at the pixels to do, each strip by strip.
#include <algorithm>
#include <cmath>

#include "morphology.h"
#include "pipeline.h"
#include "stage_timer.h"

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
// By how much the score of the best half of the views must exceed that of the estimate so far.
constexpr float kLead = 0.01f;

}  // namespace

Pipeline::ScorePass Pipeline::make_pass(const StripMap<std::uint8_t>& todo, const ViewMaps& maps) {
  const StageTimer timer(seconds_, "select");
  ScorePass pass{todo, todo, maps.bounds};
  if (options_.support.radius > 0)
    dilate(options_.support.radius, levels_[level_].shape.height, pass.score_todo,
           pass.score_bounds);
  return pass;
}

void Pipeline::score_view(int view, ViewMaps& maps) {
  scored_rows_ = {};
  // Coarser levels have too few pixels, and test too few hypotheses, for more than one look.
  const bool finest = level_ == 0, again = finest && options_.support.slanted;
  ScorePass pass = make_pass(maps.todo, maps);
  pass.scanline = finest && options_.support.scanline;
  // Where the last look has to score anew anyway, or takes very many views, a few do for the first.
  const bool few_first = again && options_.score.gradient &&
                         (options_.score.ray_mean || int(partners_[view].size()) > kManyViews);
  if (few_first) pass.views = ScoreViews::kFirst;
  score_strips(view, pass, maps);
  if (!again) return;

  StripMap<float> smooth = smooth_disparity(view, maps), means;
  StripMap<Slope> slopes = fit_slopes(view, maps.todo, smooth);
  pass.slopes = &slopes;
  score_strips(view, pass, maps);
  if (few_first) {
    smooth = smooth_disparity(view, maps);
    if (options_.score.ray_mean) {
      means = ray_means(view, pass, smooth);
      see_means(&means);
    }
    slopes = fit_slopes(view, maps.todo, smooth);
    pass.views = ScoreViews::kAll;
    scored_rows_ = {};
    score_strips(view, pass, maps);
  }
  if (options_.support.half_planes) look_behind(view, slopes, smooth, maps);
  see_means(nullptr);
}

void Pipeline::look_behind(int view, const StripMap<Slope>& slopes, const StripMap<float>& smooth,
                           ViewMaps& maps) {
  const RowRange all{0, levels_[level_].shape.height};
  StripMap<std::uint8_t> beside =
      beside_jumps(smooth, kJump * float(hypotheses_.step()), kBesideJump);
  for (int v = all.begin; v < all.end; ++v)
    for (int u = 0; u < beside.width(); ++u) beside.row(v)[u] &= maps.todo.row(v)[u];
  if (!any_set(beside, all)) return;
  ScorePass pass = make_pass(beside, maps);
  pass.slopes = &slopes;
  pass.views = ScoreViews::kHalfPlanes;
  scored_rows_ = {};
  score_strips(view, pass, maps);
}

void Pipeline::score_strips(int view, const ScorePass& pass, ViewMaps& maps) {
  const int strip_rows = plan_.levels[level_].strip_rows;
  for (const RowRange band : bands()) {
    if (!any_set(pass.todo, band)) continue;
    load_band(view, band);
    for (int v = band.begin; v < band.end; v += strip_rows) {
      const RowRange strip{v, std::min(v + strip_rows, band.end)};
      control_.throw_if_cancelled();
      if (any_set(pass.todo, strip)) score_strip(view, strip, pass, maps);
    }
  }
}

void Pipeline::score_strip(int view, RowRange rows, const ScorePass& pass, ViewMaps& maps) {
  const int height = levels_[level_].shape.height;
  const RowRange supported = grown(rows, pass.scanline ? kScanlineReach : 0, height);
  const RowRange scored = grown(supported, options_.support.radius, height);
  if (scored != scored_rows_) {
    const StageTimer timer(seconds_, "score");
    if (options_.score.gradient)
      backend_.robust_score(view, scored, pass.score_todo, pass.score_bounds, pass.views);
    else
      backend_.density_score(view, scored, pass.score_todo, pass.score_bounds);
    scored_rows_ = scored;
  }
  if (options_.support.radius > 0) {
    const StageTimer timer(seconds_, "support");
    if (pass.slopes)
      backend_.slanted_support(view, supported, pass.todo, maps.bounds, *pass.slopes);
    else
      backend_.score_support(view, supported, pass.todo, maps.bounds);
  }
  if (pass.scanline) {
    const StageTimer timer(seconds_, "scanline");
    backend_.scanline(view, rows, pass.todo);
  }
  if (pass.views == ScoreViews::kHalfPlanes)
    step_back(rows, pass, maps);
  else
    take_winners(view, rows, pass, maps);
}

void Pipeline::take_winners(int view, RowRange rows, const ScorePass& pass, ViewMaps& maps) {
  const int width = levels_[level_].shape.width;
  StripMap<float> disparity(width, rows), contrast(width, rows), edges;
  {
    const StageTimer timer(seconds_, "winner");
    backend_.winner(rows, pass.todo, maps.bounds, disparity, contrast);
  }
  const float min_relief = options_.winner.min_relief;
  if (min_relief > 0) {
    const StageTimer timer(seconds_, "winner");
    StripMap<float> best(width, rows);
    backend_.score_of_estimate(rows, pass.todo, disparity, best);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width; ++u)
        if (!(contrast.row(v)[u] > min_relief * best.row(v)[u])) contrast.row(v)[u] = 0;
  }
  if (options_.winner.weigh_by_edge) {
    const StageTimer timer(seconds_, "edges");
    edges = StripMap<float>(width, rows);
    backend_.edge_confidence(view, rows, edges);
  }
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < width; ++u) {
      if (!pass.todo.row(v)[u]) continue;
      // Too few views saw it under any hypothesis: on the last level the farther bound has to do.
      if (std::isnan(disparity.row(v)[u]) && is_last_level())
        disparity.row(v)[u] = float(hypotheses_.value(maps.bounds.row(v)[u].first));
      maps.disparity.row(v)[u] = disparity.row(v)[u];
      maps.confidence.row(v)[u] =
          contrast.row(v)[u] * (options_.winner.weigh_by_edge ? edges.row(v)[u] : 1.0f);
    }
}

// Beside a silhouette half of the views see the nearer surface, and its score wins there too: where
// the best half of the views likes something farther better, that is the answer.
void Pipeline::step_back(RowRange rows, const ScorePass& pass, ViewMaps& maps) {
  const StageTimer timer(seconds_, "winner");
  const int width = levels_[level_].shape.width;
  const float farther = kFarther * float(hypotheses_.step());
  StripMap<float> disparity(width, rows), contrast(width, rows), own(width, rows),
      best(width, rows);
  backend_.winner(rows, pass.todo, maps.bounds, disparity, contrast);
  backend_.score_of_estimate(rows, pass.todo, disparity, best);
  backend_.score_of_estimate(rows, pass.todo, maps.disparity, own);
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < width; ++u) {
      // NaN where there is nothing to do: no comparison holds.
      if (!(disparity.row(v)[u] < maps.disparity.row(v)[u] - farther)) continue;
      if (!(best.row(v)[u] >= own.row(v)[u] + kLead)) continue;
      maps.disparity.row(v)[u] = disparity.row(v)[u];
      maps.confidence.row(v)[u] = contrast.row(v)[u];
    }
}

StripMap<float> Pipeline::smooth_disparity(int view, const ViewMaps& maps) {
  const LevelShape& shape = levels_[level_].shape;
  StripMap<float> smooth(shape.width, {0, shape.height});
  for (const RowRange band : bands()) {
    load_band(view, band);
    const StageTimer timer(seconds_, "median");
    backend_.bilateral_median(view, band, options_.winner.median_radius,
                              options_.winner.median_tolerance, maps.disparity, smooth);
  }
  return smooth;
}

StripMap<float> Pipeline::ray_means(int view, const ScorePass& pass,
                                    const StripMap<float>& smooth) {
  const LevelShape& shape = levels_[level_].shape;
  StripMap<float> wanted = smooth;  // of the pixels that will be scored
  for (int v = 0; v < shape.height; ++v)
    for (int u = 0; u < shape.width; ++u)
      if (!pass.score_todo.row(v)[u]) wanted.row(v)[u] = kNoEstimate;
  StripMap<float> means(shape.width, {0, shape.height * backend_.channels()});
  for (const RowRange band : bands()) {
    load_band(view, band);
    const StageTimer timer(seconds_, "ray means");
    backend_.ray_mean(view, band, wanted, means);
  }
  return means;
}

void Pipeline::see_means(const StripMap<float>* means) {
  means_ = means;
  backend_.restore_reference();
  if (!means || loaded_band_.size() == 0) return;
  const LevelPlan& plan = plan_.levels[level_];
  backend_.replace_reference(grown(loaded_band_, plan.halo, plan.shape.height), *means);
}

StripMap<Slope> Pipeline::fit_slopes(int view, const StripMap<std::uint8_t>& todo,
                                     const StripMap<float>& smooth) {
  const LevelShape& shape = levels_[level_].shape;
  StripMap<Slope> slopes(shape.width, {0, shape.height});
  for (const RowRange band : bands()) {
    if (!any_set(todo, band)) continue;
    load_band(view, band);
    const StageTimer timer(seconds_, "slopes");
    backend_.slope_fit(view, band, smooth, slopes);
  }
  return slopes;
}

}  // namespace gigaray
