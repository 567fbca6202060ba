// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Scores of a strip and what chooses among them.
#include <algorithm>

#include "opencl/device_workspace.h"

namespace gigaray::opencl {
namespace {

/// Floats beside the states of a scan-line, see scanline.cl.
constexpr int kScanlineMargin = 16;

}  // namespace

void DeviceWorkspace::hold_scores(int volume, RowRange rows) {
  RawScores& raw = volumes_[volume];
  const RowRange kept{std::max(rows.begin, raw.rows.begin), std::min(rows.end, raw.rows.end)};
  GIGARAY_CHECK(kept.size() <= 0 || rows.begin >= raw.rows.begin);
  const std::size_t row_bytes = score_offset(1) - score_offset(0);
  if (kept.size() <= 0) {
    raw.scores.at_least(device_, volume_bytes(rows));
  } else if (volume_bytes(rows) > raw.scores.bytes) {
    Scratch larger;
    larger.at_least(device_, volume_bytes(rows));
    larger.buffer.copy_from(raw.scores.buffer, score_offset(kept.begin - raw.rows.begin),
                            score_offset(kept.begin - rows.begin), kept.size() * row_bytes);
    raw.scores = std::move(larger);
  } else if (const int shift = rows.begin - raw.rows.begin; shift > 0) {
    // Pieces that don't overlap what they replace.
    for (int v = kept.begin; v < kept.end; v += shift)
      raw.scores.buffer.copy_from(raw.scores.buffer, score_offset(v - raw.rows.begin),
                                  score_offset(v - rows.begin),
                                  std::min(shift, kept.end - v) * row_bytes);
  }
  raw.rows = rows;
  raw_ = &raw;
  winner_reads(raw.scores, rows);
}

std::size_t DeviceWorkspace::score_offset(int row) const {
  return (GIGARAY_PAD + std::size_t(row) * band_.width * hypotheses_.pitch) * sizeof(float);
}

void DeviceWorkspace::density_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                                    const Map<HypothesisBounds>& bounds) {
  const ScoreOptions& score = setup_.options.score;
  LaneKernel& kernel = lane_kernel("density_score", density_defines());
  Buffer& scores = raw_->scores.buffer;
  winner_reads(raw_->scores, raw_->rows);
  const float floor_views = score.floor_views * float(band_.num_views);
  const int min_views = std::max(1, least_views(band_.num_views));
  const LocalMemory staged = kernel.vectors(kernel.staged ? kStagedVectors * band_.num_views : 1);
  const bool packs =
      kernel.staged && kernel.lanes > 1 && !score.cubic && all_views_.rays_shift_alike;
  if (packs) {
    Buffer& counts = counts_.at_least(device_, (rows.size() + 1) * sizeof(int));
    Buffer& together = together_.at_least(device_, std::size_t(band_.height) * band_.stride);
    run_rows("find_lonely", rows, kernel.lanes, buffer_of(todo), together, counts);
    sum_counts(rows.size(), counts);
  }
  kernel.kernel.set_args(band_memory_.buffer, samples(), band_, strip(ref, rows), ways(ref),
                         hypotheses_, packs ? together_.buffer : buffer_of(todo), buffer_of(bounds),
                         score.bandwidth, min_views, floor_views, scores, raw_->rows.begin, staged);
  kernel.run(band_.width, rows.size());
  if (!packs) return;
  // As many as can stand alone; blocks beyond the end do nothing.
  LaneKernel& sparse = lane_kernel("density_score", density_defines(), "density_score_packed");
  const std::size_t blocks_of_row = round_up(band_.width, kernel.lanes) / kernel.lanes;
  const std::size_t most = blocks_of_row * (kernel.lanes / 2) * rows.size();
  Buffer& packed = packed_.at_least(device_, most * 2 * sizeof(int));
  run_rows("pack_lonely", rows, kernel.lanes, buffer_of(todo), counts_.buffer, packed);
  sparse.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), ways(ref), hypotheses_,
                         packed, counts_.buffer, buffer_of(bounds), score.bandwidth, min_views,
                         floor_views, scores, raw_->rows.begin, staged);
  sparse.run(int(most), 1);
}

void DeviceWorkspace::robust_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                                   const Map<HypothesisBounds>& bounds, ScoreViews views) {
  const ScoreOptions score = means_ ? against_means(setup_.options.score) : setup_.options.score;
  const bool halves = views == ScoreViews::kHalfPlanes;
  LaneKernel& kernel = lane_kernel("robust_score", robust_defines(halves));
  const ViewSet& members = view_set(ref, views);
  Buffer& scores = raw_->scores.buffer;
  winner_reads(raw_->scores, raw_->rows);
  const float share = halves ? kLeastHalfPlane : score.floor_views;
  const float floor_views = std::max(share * float(members.used), kLeastFloor);
  const OwnPixels own = reference_pixels(ref);
  kernel.kernel.set_args(samples(), band_, strip(ref, rows), own.buffer, own.band, own.view,
                         ways(ref), hypotheses_, buffer_of(todo), buffer_of(bounds), members.buffer,
                         score.bandwidth, score.gradient_bandwidth, score.gradient_share,
                         least_views(members.used), floor_views, score.unseen, score.colour_slack,
                         score.gradient_slack, scores, raw_->rows.begin);
  kernel.run(band_.width, rows.size());
}

void DeviceWorkspace::score_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                                    const Map<HypothesisBounds>& bounds) {
  const OwnPixels own = reference_pixels(ref);
  const SupportOptions& support = setup_.options.support;
  LaneKernel& kernel = lane_kernel("score_support", support_defines());
  Buffer& supported = supported_scores_.at_least(device_, volume_bytes(rows));
  kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), hypotheses_,
                         buffer_of(todo), buffer_of(bounds), raw_->scores.buffer, raw_->rows.begin,
                         support.sigma_colour, support.sigma_space, supported);
  kernel.run_pixels(band_.width, rows.size());
  winner_reads(supported_scores_, rows);
}

void DeviceWorkspace::slanted_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                                      const Map<HypothesisBounds>& bounds,
                                      const Map<Slope>& slopes) {
  const OwnPixels own = reference_pixels(ref);
  const SupportOptions& support = setup_.options.support;
  LaneKernel& kernel = lane_kernel("score_support", support_defines(), "slanted_support");
  Buffer& supported = supported_scores_.at_least(device_, volume_bytes(rows));
  kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), hypotheses_,
                         buffer_of(todo), buffer_of(bounds), buffer_of(slopes), raw_->scores.buffer,
                         raw_->rows.begin, support.sigma_colour, support.sigma_space, supported);
  kernel.run_pixels(band_.width, rows.size());
  winner_reads(supported_scores_, rows);
}

void DeviceWorkspace::scanline(int ref, RowRange rows, const Map<std::uint8_t>& todo) {
  const OwnPixels own = reference_pixels(ref);
  GIGARAY_CHECK(rows.begin % kScanlineBlock == 0 && winner_scores_ == &supported_scores_);
  const SupportOptions& support = setup_.options.support;
  LaneKernel& kernel = lane_kernel("scanline", "");
  Buffer& paths = path_scores_.at_least(device_, volume_bytes(score_rows_));
  const std::size_t states = 2 * (hypotheses_.pitch + 2 * kScanlineMargin) + kernel.group;
  kernels_.check_local_memory("scanline", states * sizeof(float));
  const int blocks = (rows.size() + kScanlineBlock - 1) / kScanlineBlock;
  const int directions[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (int i = 0; i < 4; ++i) {
    const auto [du, dv] = directions[i];
    kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), hypotheses_,
                           buffer_of(todo), supported_scores_.buffer, score_rows_.begin, du, dv,
                           support.small_price, support.jump_price, support.jump_sigma_colour,
                           int(i > 0), paths, LocalMemory{states * sizeof(float)});
    const std::size_t group = kernel.group;
    if (dv == 0)
      kernel.kernel.run(WorkSize(rows.size() * group, 1), WorkSize(group, 1));
    else
      kernel.kernel.run(WorkSize(band_.width * group, blocks), WorkSize(group, 1));
  }
  chosen_by_ = &path_scores_;
}

std::vector<float> DeviceWorkspace::scores_at(int u, int v) {
  GIGARAY_CHECK(score_rows_.contains(v));
  std::vector<float> scores(setup_.hypotheses.count);
  const std::size_t pixel = std::size_t(v - score_rows_.begin) * band_.width + u;
  winner_scores_->buffer.read(std::span(scores),
                              (GIGARAY_PAD + pixel * hypotheses_.pitch) * sizeof(float));
  return scores;
}

void DeviceWorkspace::winner(RowRange rows, const Map<std::uint8_t>& todo,
                             const Map<HypothesisBounds>& bounds, const Map<float>& disparity,
                             const Map<float>& contrast) {
  GIGARAY_CHECK(rows.begin >= score_rows_.begin && rows.end <= score_rows_.end);
  LaneKernel& kernel = lane_kernel("winner", winner_defines());
  const int search = chosen_by_ == winner_scores_ ? 0 : kScanlineSearch;
  const WinnerOptions& options = setup_.options.winner;
  kernel.kernel.set_args(strip(rows), hypotheses_, buffer_of(todo), buffer_of(bounds),
                         chosen_by_->buffer, winner_scores_->buffer, score_rows_.begin, search,
                         options.peak_share, options.peak_width, options.widest_peak,
                         buffer_of(disparity), buffer_of(contrast));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::score_of_estimate(RowRange rows, const Map<std::uint8_t>& todo,
                                        const Map<float>& disparity, const Map<float>& scores) {
  GIGARAY_CHECK(rows.begin >= score_rows_.begin && rows.end <= score_rows_.end);
  LaneKernel& kernel = lane_kernel("winner", winner_defines(), "score_of_estimate");
  kernel.kernel.set_args(strip(rows), hypotheses_, buffer_of(todo), winner_scores_->buffer,
                         score_rows_.begin, buffer_of(disparity), disparity.rows().begin,
                         buffer_of(scores));
  kernel.run_pixels(band_.width, rows.size());
}

}  // namespace gigaray::opencl
