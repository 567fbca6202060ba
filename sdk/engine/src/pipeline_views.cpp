// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What is to do in a view, and what becomes of its winners.
#include <limits>
#include <numeric>
#include <span>

#include "pipeline.h"

namespace gigaray {

int Pipeline::count(const std::vector<int>& counts, RowRange rows) const {
  return std::accumulate(counts.begin() + rows.begin, counts.begin() + rows.end, 0);
}

const Map<std::uint8_t>& Pipeline::opened(int radius, const Map<std::uint8_t>& mask) {
  const Map<std::uint8_t>* from = &mask;
  const Map<std::uint8_t>* to = &of_view_.scratch;
  for (int pass = 0; pass < 2 * radius; ++pass) {
    if (pass < radius)
      workspace_.erode(rows().todo, *from, *to);
    else
      workspace_.dilate(rows().todo, *from, *to);
    from = to;
    to = from == &of_view_.scratch ? &of_view_.more_scratch : &of_view_.scratch;
  }
  return *from;
}

void Pipeline::unpack_estimates(int active_idx, const Map<float>& disparity,
                                const Map<float>& confidence) {
  LevelState& state = levels_[level_];
  workspace_.unpack_estimates(rows().own, state.estimates.open_view(rows().own, active_idx),
                              disparity, confidence);
  bring_map(disparity, rows().unpacked);
  bring_map(confidence, rows().unpacked);
}

bool Pipeline::find_todo(int active_idx) {
  if (partners_[active_[active_idx]].size() < 2) return false;  // nothing to compare with
  workspace_.begin_stage("select");
  LevelState& state = levels_[level_];
  Maps& maps = of_view_;
  const RowRange own = rows().own, all = rows().todo;
  const PropagationOptions& propagation = options_.propagation;
  bool cracked = level_ == 0 && active_idx > 0 && propagation.crack_width > 0;
  if (cracked) {
    constexpr float kSameSurface = 3;  // hypotheses
    unpack_estimates(active_idx, maps.accepted, maps.more_confidence);
    const ViewRows estimates = state.estimates.open_view(all, active_idx);
    workspace_.close_cracks(all, propagation.crack_width, kSameSurface * float(hypotheses_.step()),
                            maps.accepted, maps.more_confidence, maps.disparity, maps.confidence,
                            estimates);
    state.estimates.close(all, active_idx, estimates);
    cracked = partition_->sum(count(workspace_.count_estimates(maps.disparity), own)) > 0;
  } else {
    unpack_estimates(active_idx, maps.disparity, maps.confidence);
  }

  std::vector<int> at{0};
  const ViewRows mask = state.mask.empty() ? ViewRows() : state.mask.open_view(all, active_idx);
  const ViewRows search = level_ == 0 ? ViewRows() : state.search.open_view(all, active_idx);
  const ShownRows shown = open_shown(all, {active_[active_idx]}, at);
  workspace_.select_todo(all, maps.disparity, mask, shown, at.front(), search, maps.todo,
                         maps.bounds);
  if (level_ == 0 && guide_) {
    workspace_.put(guide_->bounds(active_idx, shape().width, all, hypotheses_), maps.bounds);
    workspace_.put(guide_->hypotheses(active_idx, shape().width, all), maps.smooth);
  }
  if (cracked)
    workspace_.bound_thin_holes(all, maps.todo, opened(kThinHole, maps.todo), maps.disparity,
                                maps.bounds);
  if (cracked && !is_last_level()) {
    // Specks would cost whole windows of scores each.
    opened(1, maps.todo);
    std::swap(maps.todo, maps.more_scratch);
  }
  todo_counts_ = workspace_.count_rows(maps.todo);
  progress_.begin_view(count(todo_counts_, own));
  return partition_->sum(count(todo_counts_, own)) > 0;
}

void Pipeline::accept(int active_idx, RowRange rows, bool anything) {
  const int view = active_[active_idx];
  Maps& maps = of_view_;
  const Map<float>& accepted = maps.accepted;
  const float threshold =
      is_last_level() ? -std::numeric_limits<float>::infinity() : options_.winner.min_confidence;
  workspace_.begin_stage("median");
  const bool is_last_median = level_ > 0 || !options_.support.choose_sides;
  if (anything && is_last_median)
    workspace_.bilateral_median(view, rows, options_.winner.median_radius,
                                options_.winner.median_tolerance, maps.disparity, accepted);
  workspace_.accept(rows, threshold, maps.todo, maps.confidence, accepted);
  if (!anything) return;
  workspace_.begin_stage("radiance");
  workspace_.mean_radiance(view, rows, accepted, maps.radiance);
  if (rays_stay()) propagate(active_idx, rows);
}

void Pipeline::propagate(int active_idx, RowRange band) {
  workspace_.begin_stage("propagate");
  LevelState& state = levels_[level_];
  const int view = active_[active_idx];
  const RowRange reached = overlap(rows_needed(view, band), rows().own);
  if (reached.size() == 0) return;
  const int finished = state.bars.empty() ? 0 : active_idx;
  const RowsOnDevice estimates = state.estimates.open(reached);
  RowsOnDevice bars;
  if (finished > 0) {
    bars = state.bars.open(reached);
    workspace_.set_bars(view, band, of_view_.accepted, reached, finished, estimates, bars);
  }
  workspace_.propagation(view, band, of_view_.accepted, of_view_.confidence, of_view_.radiance,
                         reached, finished, bars, estimates);
  if (finished > 0) state.bars.close(reached, bars);
  state.estimates.close(reached, estimates);
}

void Pipeline::clear_bars(int active_idx) {
  LevelState& state = levels_[level_];
  const int view = active_[active_idx];
  if (state.bars.empty() || active_idx == 0) return;
  for (const RowRange band : bands(rows_reaching(view, rows().own))) {
    if (rays_stay() && count(todo_counts_, band) == 0) continue;
    const RowRange reached = overlap(rows_needed(view, band), rows().own);
    if (reached.size() == 0) continue;
    const RowsOnDevice bars = state.bars.open(reached);
    workspace_.clear_bars(view, band, of_view_.accepted, reached, active_idx, bars);
    state.bars.close(reached, bars);
  }
}

void Pipeline::collect_tuples(int view) {
  workspace_.begin_stage("tuples");
  constexpr int kMostAtOnce = 1 << 18;
  take_fresh_tuples();
  tuples_.begin_view();
  const RowRange own = this->rows().own;
  for (RowRange rows{own.begin, own.begin}; rows.begin < own.end; rows.begin = rows.end) {
    int most = 0;
    while (rows.end < own.end && (most == 0 || most + todo_counts_[rows.end] <= kMostAtOnce))
      most += todo_counts_[rows.end++];
    if (most == 0) continue;
    const std::size_t bytes = most * sizeof(RayTuple);
    if (!tuple_memory_ || tuple_memory_->bytes() < bytes) {
      tuple_memory_.reset();
      tuple_memory_ = workspace_.allocate(bytes);
    }
    const int found = workspace_.compact_tuples(view, rows, of_view_.accepted, of_view_.confidence,
                                                of_view_.radiance, *tuple_memory_);
    take_fresh_tuples();  // those before are there, too
    fresh_tuples_.resize(std::size_t(found));
    if (found > 0)
      workspace_.read_later(*tuple_memory_, std::as_writable_bytes(std::span(fresh_tuples_)));
  }
}

void Pipeline::take_fresh_tuples() {
  tuples_.append(fresh_tuples_);
  fresh_tuples_.clear();
}

}  // namespace gigaray
