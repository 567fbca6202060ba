// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The sweep over a view: from its scores to its accepted estimates.
#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline.h"

namespace gigaray {
namespace {

// A silhouette, and what is farther than it, in hypotheses: a difference that the outermost views
// see.
constexpr float kJump = 7, kFarther = 3;
// Samples that are scored at once: between pieces a run can be stopped, and says how far it is.
constexpr double kSamplesAtOnce = 1e9;
/// A stage that costs so much is waited for before the one after the next begins.
constexpr double kCostOfPace = 1;

/// The volumes of scores: those of the first and the slanted look, of looks that score anew, and of
/// the last look.
constexpr int kFirstScores = 0, kNewScores = 1, kLastScores = 2;

bool sees_means(SweepStep step) {
  return step >= SweepStep::kSlopesAgain && step < SweepStep::kAccept;
}

}  // namespace

// Every stage follows the one before at the distance that it looks ahead, so that the pixels of a
// view are loaded once, whatever the number of strips. All rows in one strip: each stage does all
// of them in turn.
void Pipeline::sweep(int active_idx) {
  const int view = active_[active_idx];
  const LevelPlan& plan = plan_.levels[level_];
  stages_ = sweep_stages(options_, level_, int(partners_[view].size()), guide_ != nullptr);
  stage_rows_ = rows_of_stages(stages_, rows().own, shape().height);
  progress_of_stages_.clear();
  for (const RowRange rows : stage_rows_) progress_of_stages_.push_back(rows.begin);
  std::vector<int>& done = progress_of_stages_;
  paced_ = 0;
  grow_todo();
  for (int volume = 0; volume < int(held_scores_.size()); ++volume) hold_scores(volume, {});
  while (done.back() < stage_rows_.back().end) {
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      const SweepStage& stage = stages_[i];
      const int last = stage_rows_[i].end;
      int possible = last;
      if (i > 0 && done[i - 1] < stage_rows_[i - 1].end)
        possible = std::min((done[i - 1] - stage.reach) / stage.multiple * stage.multiple, last);
      // At the end of the view a stage has what it lagged before it, too: no more at once than the
      // plan has memory for.
      const int end = std::min(possible, done[i] + plan.strip_rows);
      if (end <= done[i]) continue;
      control_.throw_if_cancelled();
      see_means(options_.score.ray_mean && sees_means(stage.step));
      stage_at_work_ = i;
      run_stage(active_idx, stage.step, {done[i], end}, done);
      done[i] = end;
      // A coarser level in one strip is soon done.
      if (stage.cost >= kCostOfPace && (level_ == 0 || end < last)) keep_pace(sweep_share());
    }
  }
  see_means(false);
}

double Pipeline::cost_of_sweep() const {
  double cost = 0;
  for (std::size_t i = 0; i < stages_.size(); ++i) cost += stages_[i].cost * stage_rows_[i].size();
  return cost;
}

double Pipeline::sweep_share() const {
  double done = 0;
  for (std::size_t i = 0; i < stages_.size(); ++i)
    done += stages_[i].cost * (progress_of_stages_[i] - stage_rows_[i].begin);
  return done / cost_of_sweep();
}

void Pipeline::keep_pace(double sweep_share) {
  workspace_.keep_pace();
  report(progress_.share(paced_));
  paced_ = sweep_share;
}

void Pipeline::run_stage(int active_idx, SweepStep step, RowRange rows,
                         const std::vector<int>& done) {
  const int view = active_[active_idx];
  Maps& maps = of_view_;
  const bool anything = count(todo_counts_, rows) > 0;
  const auto load = [&] { load_sweep(view, rows, done); };
  switch (step) {
    case SweepStep::kLook:
    case SweepStep::kSlantedLook:
    case SweepStep::kLastLook:
      if (!anything) return;
      load();
      return look(view, step, rows);
    case SweepStep::kSmooth:
    case SweepStep::kSmoothAgain:
    case SweepStep::kLastMedian:
      load();
      workspace_.begin_stage("median");
      return workspace_.bilateral_median(view, rows, options_.winner.median_radius,
                                         options_.winner.median_tolerance, maps.disparity,
                                         maps.smooth);
    case SweepStep::kSlopes:
    case SweepStep::kSlopesAgain:
      if (!anything) return;
      load();
      workspace_.begin_stage("slopes");
      return workspace_.slope_fit(view, rows, maps.todo, maps.smooth, maps.slopes);
    case SweepStep::kMeans:
      load();
      workspace_.begin_stage("ray means");
      return workspace_.ray_mean(view, rows, maps.grown_todo, maps.smooth, maps.means);
    case SweepStep::kMeanGradients:
      workspace_.begin_stage("ray means");
      return workspace_.mean_gradients(rows, maps.means);
    case SweepStep::kBeside:
      workspace_.begin_stage("select");
      return workspace_.beside_jumps(rows, maps.smooth, kJump * float(hypotheses_.step()),
                                     kBesideJump, maps.todo, maps.beside);
    case SweepStep::kLookBehind:
      if (!anything) return;
      load();
      return look_behind(view, rows);
    case SweepStep::kSideEvidence:
      load();
      return find_sides(view, rows, maps.smooth);
    case SweepStep::kSideEvidenceAgain:
      load();
      return find_sides(view, rows, maps.disparity);
    case SweepStep::kChooseSides:
      load();
      return choose_sides(view, rows, maps.smooth, maps.confidence, maps.disparity,
                          maps.side_confidence);
    case SweepStep::kChooseSidesAgain:
      load();
      return choose_sides(view, rows, maps.disparity, maps.side_confidence, maps.accepted,
                          maps.confidence);
    case SweepStep::kHidden:
      load();
      workspace_.begin_stage("hidden");
      return workspace_.find_hidden(view, rows, way_of_a_pixel(view), maps.todo, maps.accepted,
                                    maps.confidence, maps.scratch);
    case SweepStep::kSpecks:
      return workspace_.find_specks(rows, way_of_a_pixel(view), maps.todo, maps.accepted,
                                    maps.scratch, maps.more_scratch);
    case SweepStep::kFillHidden:
      return workspace_.fill_hidden(rows, way_of_a_pixel(view), maps.more_scratch, maps.accepted,
                                    maps.confidence);
    case SweepStep::kAccept:
      if (anything) load();
      return accept(active_idx, rows, anything);
  }
}

void Pipeline::grow_todo() {
  workspace_.begin_stage("select");
  const int radius = options_.support.radius;
  if (radius > 0)
    workspace_.grow_todo(rows().todo, radius, of_view_.todo, of_view_.bounds, of_view_.grown_todo,
                         of_view_.grown_bounds);
}

// Scores of rows that are held and not there yet, in pieces.
void Pipeline::score(int view, RowRange rows, ScoreViews views, const Map<std::uint8_t>& todo,
                     const Map<HypothesisBounds>& bounds) {
  workspace_.begin_stage("score");
  // Scores are half of a look.
  const double part = 0.5 * stages_[stage_at_work_].cost * rows.size() / cost_of_sweep();
  const double samples_per_pixel = double(hypotheses_.count) * double(partners_[view].size());
  for (RowRange piece{rows.begin, rows.begin}; piece.end < rows.end; piece.begin = piece.end) {
    double samples = 0;
    while (piece.end < rows.end && samples < kSamplesAtOnce)
      samples += samples_per_pixel * todo_counts_[piece.end++];
    if (options_.score.gradient)
      workspace_.robust_score(view, piece, todo, bounds, views);
    else
      workspace_.density_score(view, piece, todo, bounds);
    if (piece.end == rows.end) continue;
    const double scored = double(piece.end - rows.begin) / rows.size();
    keep_pace(sweep_share() + scored * part);
    control_.throw_if_cancelled();
  }
}

void Pipeline::hold_scores(int volume, RowRange rows) {
  workspace_.hold_scores(volume, rows);
  held_scores_[volume] = rows;
}

void Pipeline::score_more(int volume, RowRange held, int view, RowRange rows, ScoreViews views,
                          const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds) {
  const int wanted = std::max(held_scores_[volume].end, rows.begin);
  hold_scores(volume, held);
  score(view, {wanted, rows.end}, views, todo, bounds);
}

void Pipeline::score_anew(int view, RowRange rows, ScoreViews views, const Map<std::uint8_t>& todo,
                          const Map<HypothesisBounds>& bounds) {
  // In one strip nothing asks for the scores of the first look any more.
  const bool in_one_strip = plan_.levels[level_].strip_rows >= stage_rows_.front().size();
  const int volume = in_one_strip ? kFirstScores : kNewScores;
  hold_scores(volume, {});
  hold_scores(volume, rows);
  score(view, rows, views, todo, bounds);
}

void Pipeline::look(int view, SweepStep step, RowRange rows) {
  const int height = shape().height, radius = options_.support.radius;
  const bool scanline = level_ == 0 && options_.support.scanline;
  const bool few =
      options_.support.slanted && level_ == 0 && few_first(options_, int(partners_[view].size()));
  const RowRange supported = grown(rows, scanline ? kScanlineReach : 0, height);
  const RowRange scored = grown(supported, radius, height);
  const auto& score_todo = radius > 0 ? of_view_.grown_todo : of_view_.todo;
  const auto& score_bounds = radius > 0 ? of_view_.grown_bounds : of_view_.bounds;
  const ScoreViews views =
      few && step != SweepStep::kLastLook ? ScoreViews::kFirst : ScoreViews::kAll;
  const LevelPlan& plan = plan_.levels[level_];
  const bool keeps = plan.keeps_scores;
  if (step == SweepStep::kLook && keeps) {
    // Those below what the slanted look will ask for next go.
    score_more(kFirstScores, {std::min(scored.begin, slanted_scores_begin()), scored.end}, view,
               scored, views, score_todo, score_bounds);
  } else if (step == SweepStep::kSlantedLook && keeps) {
    hold_scores(kFirstScores, held_scores_[kFirstScores]);
  } else if (step == SweepStep::kLastLook && keeps &&
             plan.strip_rows < stage_rows_.front().size()) {
    score_more(kLastScores, scored, view, scored, views, score_todo, score_bounds);
  } else {
    score_anew(view, scored, views, score_todo, score_bounds);
  }
  const bool along_slopes = step != SweepStep::kLook || (level_ == 0 && guide_);
  support(view, supported, of_view_.todo, along_slopes);
  if (scanline) {
    workspace_.begin_stage("scanline");
    workspace_.scanline(view, rows, of_view_.todo);
  }
  workspace_.begin_stage("winner");
  const auto winners = strip<float>(0, rows), contrast = strip<float>(1, rows);
  workspace_.winner(rows, of_view_.todo, of_view_.bounds, winners, contrast);
  take_winners(view, rows, winners, contrast);
}

int Pipeline::slanted_scores_begin() const {
  const int reach = (options_.support.scanline ? kScanlineReach : 0) + options_.support.radius;
  for (std::size_t i = 0; i < stages_.size(); ++i)
    if (stages_[i].step == SweepStep::kSlantedLook)
      return std::max(progress_of_stages_[i] - reach, 0);
  return shape().height;
}

void Pipeline::support(int view, RowRange rows, const Map<std::uint8_t>& todo, bool along_slopes) {
  if (options_.support.radius == 0) return;
  workspace_.begin_stage("support");
  if (along_slopes)
    workspace_.slanted_support(view, rows, todo, of_view_.bounds, of_view_.slopes);
  else
    workspace_.score_support(view, rows, todo, of_view_.bounds);
}

void Pipeline::look_behind(int view, RowRange rows) {
  Maps& maps = of_view_;
  const RowRange scored = grown(rows, options_.support.radius, shape().height);
  workspace_.begin_stage("select");
  workspace_.grow_todo(scored, options_.support.radius, maps.beside, maps.bounds, maps.behind_todo,
                       maps.behind_bounds);
  score_anew(view, scored, ScoreViews::kHalfPlanes, maps.behind_todo, maps.behind_bounds);
  support(view, rows, maps.beside, true);
  workspace_.begin_stage("winner");
  const auto winners = strip<float>(0, rows), contrast = strip<float>(1, rows);
  const auto best = strip<float>(2, rows), own = strip<float>(3, rows);
  workspace_.winner(rows, maps.beside, maps.bounds, winners, contrast);
  workspace_.score_of_estimate(rows, maps.beside, winners, best);
  workspace_.score_of_estimate(rows, maps.beside, maps.disparity, own);
  workspace_.step_back(rows, kFarther * float(hypotheses_.step()), winners, contrast, best, own,
                       maps.disparity, maps.confidence);
}

void Pipeline::find_sides(int view, RowRange rows, const Map<float>& disparity) {
  workspace_.begin_stage("sides");
  workspace_.side_evidence(view, rows, kJump * float(hypotheses_.step()), of_view_.todo, disparity,
                           of_view_.evidence);
}

void Pipeline::choose_sides(int view, RowRange rows, const Map<float>& disparity,
                            const Map<float>& confidence, const Map<float>& chosen,
                            const Map<float>& chosen_confidence) {
  workspace_.begin_stage("sides");
  workspace_.choose_sides(view, rows, kJump * float(hypotheses_.step()), disparity, confidence,
                          of_view_.evidence, chosen, chosen_confidence);
}

float Pipeline::way_of_a_pixel(int view) const {
  const Ray nearest{0.5 * shape().width, 0.5 * shape().height, hypotheses_.max};
  const Ray farthest{nearest.u, nearest.v, hypotheses_.min};
  double most = 0;
  for (const int other : partners_[view]) {
    const auto [near, far] = std::visit(
        [&](const auto& sampler) {
          return std::pair(sampler.locate(view, other, nearest),
                           sampler.locate(view, other, farthest));
        },
        sampler_);
    if (near && far) most = std::max(most, std::hypot(near->u - far->u, near->v - far->v));
  }
  return float((hypotheses_.max - hypotheses_.min) / std::max(most, 1.0));
}

void Pipeline::take_winners(int view, RowRange rows, const Map<float>& winners,
                            const Map<float>& contrast) {
  Map<float> best, edges;
  if (options_.winner.min_relief > 0) {
    best = strip<float>(2, rows);
    workspace_.score_of_estimate(rows, of_view_.todo, winners, best);
  }
  if (options_.winner.weigh_by_edge) {
    edges = strip<float>(3, rows);
    workspace_.edge_confidence(view, rows, edges);
  }
  workspace_.take_winners(rows, is_last_level(), of_view_.todo, of_view_.bounds, winners, contrast,
                          best, edges, of_view_.disparity, of_view_.confidence);
}

void Pipeline::see_means(bool see) {
  if (see == sees_means_) return;
  sees_means_ = see;
  if (see)
    workspace_.replace_reference(of_view_.means);
  else
    workspace_.restore_reference();
}

}  // namespace gigaray
