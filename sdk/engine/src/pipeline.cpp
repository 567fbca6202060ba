// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pipeline.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "stage_timer.h"

namespace gigaray {

Pipeline::Pipeline(const Run& run, const std::vector<std::vector<PartitionRows>>& rows,
                   DecodedPictures pictures, Workspace& workspace, RunResult& result)
    : light_field_(run.light_field),
      options_(run.options),
      hypotheses_(run.hypotheses),
      plan_(run.plan),
      control_(run.control),
      guide_(run.guide),
      rows_(rows),
      pictures_(std::move(pictures)),
      workspace_(workspace),
      result_(result),
      sampler_(make_sampler(run.light_field)),
      active_(active_views(run.light_field, run.options)),
      tuples_(run.plan.work_folder) {
  for (int view = 0; view < light_field_.num_views(); ++view)
    partners_.push_back(
        std::visit([&](const auto& sampler) { return sampler.partners(view); }, sampler_));
  for (std::size_t level = 0; level < plan_.levels.size(); ++level)
    rays_stay_.push_back(do_rays_stay(int(level)));
}

void Pipeline::run(Partition& partition) {
  partition_ = &partition;
  workspace_.set_active_views(active_);
  for (level_ = 0; level_ < int(plan_.levels.size()); ++level_) {
    begin_level();
    find_edges_and_downsample();
    for (int i = 0; i < int(active_.size()); ++i) {
      report(progress_.share(1));
      if (!find_todo(i)) continue;
      sweep(i);
      propagate_to_others(i);
      clear_bars(i);
      collect_tuples(active_[i]);
    }
    // The next level, and the finished maps, begin in the middle of two rows.
    LevelState& state = levels_[level_];
    bring_rows(state.estimates, level_, grown(rows().own, 1, shape().height));
    if (!is_last_level()) coarsen();
    if (options_.keep_searches && level_ > 0) keep_searches();
    for (LevelRows* rows : {&state.pixels, &state.mask, &state.bars, &state.search})
      *rows = LevelRows();
  }
  finish();
  report(0);
}

void Pipeline::report(double done) {
  // A level has a quarter of the pixels of the level before: its share of the work.
  const double before = 1 - std::pow(0.25, level_), share = 0.75 * std::pow(0.25, level_);
  const bool finished = level_ >= int(plan_.levels.size());
  if (partition_->index() > 0) return control_.throw_if_cancelled();
  control_.progress(finished ? "depth" : "level " + std::to_string(level_),
                    finished ? 1 : before + share * done, 1);
}

std::map<std::string, double> Pipeline::seconds() const {
  std::map<std::string, double> seconds = workspace_.seconds();
  for (const auto& [stage, value] : seconds_) seconds[stage] += value;
  return seconds;
}

// ---- Pixels -------------------------------------------------------------------------------------

void Pipeline::begin_level() {
  const int views = light_field_.num_views();
  const std::size_t active = active_.size(), width = plan_.levels[level_].shape.width;
  if (level_ == 0) {
    levels_.emplace_back().shape = plan_.levels[0].shape;
    levels_[0].pixels =
        LevelRows(workspace_, std::move(pictures_.pixels), rows().pixels, views, plan_.place);
    // Coarser levels look at rows of it that are farther away.
    if (pictures_.shown)
      shown_ = LevelRows(workspace_, std::move(pictures_.shown), {0, light_field_.height}, views,
                         plan_.place);
  }
  LevelState& state = levels_[level_];
  state.estimates = make_rows(rows().todo, active, width * sizeof(PackedEstimate));
  if (options_.propagation.finished_lead > 0 && active > 1)
    state.bars = make_rows(rows().todo, active, width * sizeof(float));
  if (options_.edge.threshold >= 0 && !is_last_level())
    state.mask = make_rows(rows().todo, active, width);
  if (!is_last_level()) {
    LevelState next;
    next.shape = plan_.levels[level_ + 1].shape;
    const PartitionRows& next_rows = rows_of(level_ + 1);
    next.pixels = make_rows(next_rows.pixels, views, 3 * next.shape.width * sizeof(float));
    next.search = make_rows(next_rows.todo, active, next.shape.width * sizeof(Search));
    levels_.push_back(std::move(next));
  }
  workspace_.begin_level(shape(), plan_.levels[level_].loaded_rows);
  loaded_sweep_ = {};
  loaded_views_.clear();
  progress_ = LevelProgress(int(active), double(width) * rows().own.size());
  make_maps();
}

void Pipeline::make_maps() {
  const int width = shape().width;
  const RowRange all = shape().rows();
  const SupportOptions& support = options_.support;
  Maps& maps = of_view_;
  maps = {};
  maps.todo = workspace_.make_map<std::uint8_t>(width, all);
  maps.bounds = workspace_.make_map<HypothesisBounds>(width, all);
  maps.disparity = workspace_.make_map<float>(width, all);
  maps.confidence = workspace_.make_map<float>(width, all);
  maps.accepted = workspace_.make_map<float>(width, all);
  maps.radiance = workspace_.make_map<Radiance>(width, all);
  maps.scratch = workspace_.make_map<std::uint8_t>(width, all);
  maps.more_scratch = workspace_.make_map<std::uint8_t>(width, all);
  if (support.radius > 0) {
    maps.grown_todo = workspace_.make_map<std::uint8_t>(width, all);
    maps.grown_bounds = workspace_.make_map<HypothesisBounds>(width, all);
  }
  if (level_ == 0 && options_.propagation.crack_width > 0)
    maps.more_confidence = workspace_.make_map<float>(width, all);
  if (level_ > 0 || !support.slanted) return;
  maps.smooth = workspace_.make_map<float>(width, all);
  maps.slopes = workspace_.make_map<Slope>(width, all);
  if (support.half_planes) {
    maps.beside = workspace_.make_map<std::uint8_t>(width, all);
    maps.behind_todo = workspace_.make_map<std::uint8_t>(width, all);
    maps.behind_bounds = workspace_.make_map<HypothesisBounds>(width, all);
  }
  if (support.choose_sides) {
    maps.evidence = workspace_.make_map<float>(width, all);
    maps.side_confidence = workspace_.make_map<float>(width, all);
  }
  if (options_.score.ray_mean)
    maps.means = workspace_.make_map<float>(width, {0, all.size() * workspace_.channels()});
}

std::vector<RowRange> Pipeline::bands(RowRange rows) const {
  const LevelPlan& plan = plan_.levels[level_];
  std::vector<RowRange> bands;
  for (int v = rows.begin; v < rows.end; v += plan.band_rows)
    bands.push_back({v, std::min(v + plan.band_rows, rows.end)});
  return bands;
}

RowRange Pipeline::rows_needed(int view, RowRange rows) const {
  return std::visit(
      [&](const auto& sampler) {
        return sampler.at_level(level_).rows_needed(view, rows, hypotheses_, shape().height);
      },
      sampler_);
}

void Pipeline::load_sweep(int view, RowRange rows, const std::vector<int>& done) {
  const LevelPlan& plan = plan_.levels[level_];
  const int height = plan.shape.height, last = stage_rows_.front().end;
  int first = last;
  for (std::size_t i = 0; i < done.size(); ++i)
    if (done[i] < stage_rows_[i].end) first = std::min(first, done[i]);
  const RowRange wanted =
      plan.window_rows > 0
          ? RowRange{first, std::max(std::min(done.front() + plan.strip_rows, last), rows.end)}
          : rows;
  if (loaded_sweep_.size() > 0 && wanted.begin >= loaded_sweep_.begin &&
      wanted.end <= loaded_sweep_.end && partners_[view] == loaded_views_)
    return;
  const RowRange window{wanted.begin,
                        std::max(wanted.end, std::min(first + plan.window_rows, last))};
  load_rows(partners_[view], rows_needed(view, grown(window, plan.halo, height)), true);
  loaded_sweep_ = window;
  if (sees_means_) workspace_.replace_reference(of_view_.means);
}

ShownRows Pipeline::open_shown(RowRange rows, const std::vector<int>& views, std::vector<int>& at) {
  if (shown_.empty()) return {};
  if (shown_.on_device() || level_ == 0)
    return {shown_.open(rows, views, at), light_field_.width, level_};
  return {shown_.open_coarse(rows, level_, views, at), shape().width, 0};
}

void Pipeline::load_rows(const std::vector<int>& views, RowRange rows, bool masked) {
  control_.throw_if_cancelled();
  masked = masked && !shown_.empty();
  const RowRange missing = masked == loaded_masked_ ? workspace_.missing_rows(rows, views) : rows;
  if (missing.size() == 0) return;
  workspace_.begin_stage("load");
  const StageTimer timer(seconds_, "load");
  loaded_sweep_ = {};
  EncodedRows source;
  source.encoding = level_ > 0                              ? BandEncoding::kFloat
                    : light_field_.pixels->bit_depth() == 8 ? BandEncoding::kBits8
                                                            : BandEncoding::kBits16;
  if (masked) source.shown = open_shown(missing, views, source.at);
  source.pixels = levels_[level_].pixels.open(missing, views, source.at);
  workspace_.load_band(rows, missing, views, source);
  loaded_views_ = views;
  loaded_masked_ = masked;
}

std::vector<std::vector<int>> Pipeline::view_groups() const {
  std::size_t most = 0;
  for (const std::vector<int>& partners : partners_) most = std::max(most, partners.size());
  std::vector<std::vector<int>> groups;
  for (int view = 0; view < light_field_.num_views(); ++view) {
    if (groups.empty() || groups.back().size() == most) groups.emplace_back();
    groups.back().push_back(view);
  }
  return groups;
}

void Pipeline::find_edges_and_downsample() {
  LevelState& state = levels_[level_];
  const std::vector<RowRange> all = bands(rows().todo);
  // One band serves the views too, so it is loaded in any case.
  if (state.mask.empty() && is_last_level() && all.size() > 1) return;
  for (const RowRange band : all)
    for (const std::vector<int>& group : view_groups()) {
      RowRange around = grown(band, plan_.levels[level_].halo, shape().height);
      // All views in one group: what is loaded serves the rays of the first view too.
      if (group.size() == light_field_.views.size()) around = rows_needed(active_.front(), around);
      load_rows(group, around, false);
      if (!state.mask.empty()) find_edges(group, band);
      if (!is_last_level()) downsample(group, band);
    }
  if (!is_last_level())
    bring_rows(levels_[level_ + 1].pixels, level_ + 1, rows_of(level_ + 1).pixels);
}

void Pipeline::find_edges(const std::vector<int>& views, RowRange band) {
  workspace_.begin_stage("edges");
  LevelState& state = levels_[level_];
  const int height = state.shape.height;
  const RowRange around = grown(band, options_.edge.opening ? 2 : 0, height);
  const auto edges = strip<float>(0, around);
  const auto mask = strip<std::uint8_t>(1, around), eroded = strip<std::uint8_t>(2, around),
             opened = strip<std::uint8_t>(3, band);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (!std::binary_search(views.begin(), views.end(), active_[i])) continue;
    workspace_.edge_confidence(active_[i], around, edges);
    workspace_.edge_mask(around, edges, options_.edge.threshold, mask);
    if (options_.edge.opening) {
      workspace_.erode(grown(band, 1, height), mask, eroded);
      workspace_.dilate(band, eroded, opened);
    }
    const ViewRows to = state.mask.open_view(band, int(i));
    workspace_.put_mask(band, options_.edge.opening ? opened : mask, to);
    state.mask.close(band, int(i), to);
  }
}

void Pipeline::downsample(const std::vector<int>& views, RowRange band) {
  const RowRange own = rows_of(level_ + 1).own;
  const RowRange small{std::max((band.begin + 1) / 2, own.begin),
                       std::min((band.end + 1) / 2, own.end)};
  if (small.size() <= 0) return;
  workspace_.begin_stage("downsample");
  LevelRows& next = levels_[level_ + 1].pixels;
  std::vector<int> at;
  const RowsOnDevice rows = next.open(small, views, at);
  workspace_.downsample(small, rows, at.front());  // a group is a run of views
  next.close(small, views, rows);
}

void Pipeline::coarsen() {
  workspace_.begin_stage("bounds");
  LevelState& fine = levels_[level_];
  LevelState& coarse = levels_[level_ + 1];
  const RowRange own = rows_of(level_ + 1).own;
  // Rows that are brought to the device at once, where they are not there already.
  constexpr std::size_t kBytesAtOnce = 64 << 20;
  const std::size_t row_bytes =
      active_.size() * fine.shape.width * (2 * sizeof(PackedEstimate) + 3 * sizeof(Search));
  const int rows_at_once = fine.estimates.on_device()
                               ? own.size()
                               : int(std::max<std::size_t>(kBytesAtOnce / row_bytes, 1));
  for (int v = own.begin; v < own.end; v += rows_at_once) {
    control_.throw_if_cancelled();
    const RowRange rows{v, std::min(v + rows_at_once, own.end)};
    const RowRange fine_rows{2 * rows.begin, std::min(2 * rows.end, fine.shape.height)};
    const RowsOnDevice estimates = fine.estimates.open(fine_rows);
    const RowsOnDevice search = level_ > 0 ? fine.search.open(fine_rows) : RowsOnDevice();
    const RowsOnDevice out = coarse.search.open(rows);
    for (int i = 0; i < int(active_.size()); ++i)
      workspace_.coarsen_bounds(rows, {estimates, i}, {search, i}, {out, i});
    coarse.search.close(rows, out);
  }
  bring_rows(coarse.search, level_ + 1, rows_of(level_ + 1).todo);
}

void Pipeline::keep_searches() {
  LevelRows& search = levels_[level_].search;
  std::vector<std::byte> row(search.row_bytes());
  partition_->in_turn([&] {
    if (partition_->index() == 0)
      result_.searches.push_back(
          {shape(), RowStore(shape().height, row.size(), plan_.work_folder)});
    for (int v = rows().own.begin; v < rows().own.end; ++v) {
      search.read({v, v + 1}, row.data());
      result_.searches.back().rows.write(v, 0, row.size(), row.data());
    }
  });
}

void Pipeline::finish() {
  workspace_.begin_stage("fill");
  of_view_ = {};
  const LevelShape& finest = levels_.front().shape;
  partition_->in_turn([&] {
    if (result_.maps.empty())
      result_.maps =
          FinishedMaps(int(active_.size()), finest.width, finest.height, plan_.work_folder);
  });
  std::vector<ViewMaps> filled;
  for (const LevelState& state : levels_) {
    const int width = state.shape.width;
    const RowRange all = state.shape.rows();
    filled.push_back({workspace_.make_map<float>(width, all),
                      workspace_.make_map<float>(width, all),
                      workspace_.make_map<std::int8_t>(width, all)});
  }
  const RowRange own = rows_of(0).own;
  StripMap<float> disparity(finest.width, own), confidence = disparity;
  StripMap<std::int8_t> decided(finest.width, own);
  const FinishSteps finish_steps(workspace_);
  const auto bytes_of = [&](auto& map) {
    return std::as_writable_bytes(std::span(map.padded_row(own.begin), map.pitch() * own.size()));
  };
  const std::size_t first = std::size_t(own.begin) * disparity.pitch();
  for (int i = 0; i < int(active_.size()); ++i) {
    control_.throw_if_cancelled();
    for (level_ = int(levels_.size()) - 1; level_ >= 0; --level_) {
      LevelState& state = levels_[level_];
      const RowRange wanted = grown(rows().own, 1, state.shape.height);
      std::vector<int> at{0};
      const ShownRows shown = level_ == 0 ? open_shown(wanted, {active_[i]}, at) : ShownRows{};
      workspace_.fill_view(wanted, state.shape, state.estimates.open_view(wanted, i),
                           level_ + 1 < int(levels_.size()) ? filled[level_ + 1] : ViewMaps{},
                           shown, at.front(), filled[level_]);
    }
    workspace_.read_later(filled[0].disparity.memory(), bytes_of(disparity), first * sizeof(float));
    workspace_.read_later(filled[0].confidence.memory(), bytes_of(confidence),
                          first * sizeof(float));
    workspace_.read(filled[0].level.memory(), bytes_of(decided), first);
    result_.maps.put(i, disparity, confidence, decided);
  }
  take_fresh_tuples();
  level_ = int(levels_.size());
}

}  // namespace gigaray
