// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pipeline.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "gigaray/parallel.h"
#include "stage_timer.h"

namespace gigaray {

Pipeline::Pipeline(const LightField& light_field, const DepthOptions& options,
                   const HypothesisRange& hypotheses, const MemoryPlan& plan, Workspace& workspace,
                   const RunControl& control)
    : light_field_(light_field),
      options_(options),
      hypotheses_(hypotheses),
      plan_(plan),
      workspace_(workspace),
      control_(control),
      sampler_(make_sampler(light_field)),
      tuples_(plan.work_folder) {
  for (const int view : views_from_centre(light_field))
    if (options.views.empty() ||
        std::find(options.views.begin(), options.views.end(), view) != options.views.end())
      active_.push_back(view);
  for (int view = 0; view < light_field.num_views(); ++view)
    partners_.push_back(
        std::visit([&](const auto& sampler) { return sampler.partners(view); }, sampler_));
}

void Pipeline::run() {
  workspace_.set_active_views(active_);
  for (level_ = 0; level_ < int(plan_.levels.size()); ++level_) {
    begin_level(level_);
    find_edges_and_downsample();
    for (int i = 0; i < int(active_.size()); ++i) {
      report(double(i) / double(active_.size()));
      if (!find_todo(i)) continue;
      sweep(i);
      clear_bars(i);
      collect_tuples(active_[i]);
    }
    if (!is_last_level()) coarsen();
    if (options_.keep_searches && level_ > 0) keep_searches();
    LevelState& state = levels_[level_];
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
  control_.progress(finished ? "depth" : "level " + std::to_string(level_),
                    finished ? 1 : before + share * done, 1);
}

std::map<std::string, double> Pipeline::seconds() const {
  std::map<std::string, double> seconds = workspace_.seconds();
  for (const auto& [stage, value] : seconds_) seconds[stage] += value;
  return seconds;
}

// ---- Pixels -------------------------------------------------------------------------------------

void Pipeline::decode() {
  const StageTimer timer(seconds_, "decode");
  const int height = light_field_.height, views = light_field_.num_views();
  const std::size_t width = light_field_.width;
  const std::size_t value_bytes = light_field_.pixels->bit_depth() / 8;
  const std::size_t line = width * 3;
  RowStore pixels(height, views * line * value_bytes, plan_.work_folder), shown;
  if (light_field_.pixels->has_mask()) shown = RowStore(height, views * width, plan_.work_folder);

  control_.progress("decode", 0, views);
  const auto decode_view = [&](int view) {
    Image<std::uint16_t> picture = read_view(light_field_, view);
    light_field_.pixels->let_go(view);
    if (const auto mask = take_mask(picture))
      for (int v = 0; v < height; ++v) shown.write(v, view * width, width, mask->row(v));
    std::vector<std::uint8_t> bytes(line);
    for (int v = 0; v < height; ++v) {
      const void* row = picture.row(v);
      if (value_bytes == 1) {
        std::copy(picture.row(v), picture.row(v) + line, bytes.begin());
        row = bytes.data();
      }
      pixels.write(v, view * line * value_bytes, line * value_bytes, row);
    }
  };
  parallel_for(
      views, decode_view, [&](int done) { control_.progress("decode", done, views); },
      plan_.decoders);
  levels_[0].pixels = LevelRows(workspace_, std::move(pixels), height, views, plan_.place);
  if (!shown.empty()) shown_ = LevelRows(workspace_, std::move(shown), height, views, plan_.place);
}

void Pipeline::begin_level(int level) {
  const LevelShape& shape = plan_.levels[level].shape;
  const std::size_t views = light_field_.num_views(), active = active_.size(), width = shape.width;
  if (level == 0) {
    levels_.emplace_back().shape = shape;
    decode();
  }
  LevelState& state = levels_[level];
  state.estimates = make_rows(shape.height, active, width * sizeof(PackedEstimate));
  if (options_.propagation.finished_lead > 0 && active > 1)
    state.bars = make_rows(shape.height, active, width * sizeof(float));
  if (options_.edge.threshold >= 0 && !is_last_level())
    state.mask = make_rows(shape.height, active, width);
  if (!is_last_level()) {
    LevelState next;
    next.shape = plan_.levels[level + 1].shape;
    next.pixels = make_rows(next.shape.height, views, 3 * next.shape.width * sizeof(float));
    next.search = make_rows(next.shape.height, active, next.shape.width * sizeof(Search));
    levels_.push_back(std::move(next));
  }
  workspace_.begin_level(shape, plan_.levels[level].loaded_rows);
  loaded_sweep_ = {};
  loaded_views_.clear();
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
  if (options_.score.ray_mean)
    maps.means = workspace_.make_map<float>(width, {0, all.size() * workspace_.channels()});
}

std::vector<RowRange> Pipeline::bands() const {
  const LevelPlan& plan = plan_.levels[level_];
  std::vector<RowRange> bands;
  for (int v = 0; v < plan.shape.height; v += plan.band_rows)
    bands.push_back({v, std::min(v + plan.band_rows, plan.shape.height)});
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
  const int height = plan.shape.height;
  int first = height;
  for (const int row : done)
    if (row < height) first = std::min(first, row);
  const RowRange wanted = plan.window_rows > 0
                              ? RowRange{first, std::min(done.front() + plan.strip_rows, height)}
                              : rows;
  if (loaded_sweep_.size() > 0 && wanted.begin >= loaded_sweep_.begin &&
      wanted.end <= loaded_sweep_.end && partners_[view] == loaded_views_)
    return;
  const RowRange window{wanted.begin,
                        std::max(wanted.end, std::min(first + plan.window_rows, height))};
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
  // One band serves the views too, so it is loaded in any case.
  if (state.mask.empty() && is_last_level() && bands().size() > 1) return;
  for (const RowRange band : bands())
    for (const std::vector<int>& group : view_groups()) {
      RowRange rows = grown(band, plan_.levels[level_].halo, shape().height);
      // All views in one group: what is loaded serves the rays of the first view too.
      if (group.size() == light_field_.views.size()) rows = rows_needed(active_.front(), rows);
      load_rows(group, rows, false);
      if (!state.mask.empty()) find_edges(group, band);
      if (!is_last_level()) downsample(group, band);
    }
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
  const RowRange small{(band.begin + 1) / 2, (band.end + 1) / 2};
  if (small.size() == 0) return;
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
  // Rows that are brought to the device at once, where they are not there already.
  constexpr std::size_t kBytesAtOnce = 64 << 20;
  const std::size_t row_bytes =
      active_.size() * fine.shape.width * (2 * sizeof(PackedEstimate) + 3 * sizeof(Search));
  const int rows_at_once = fine.estimates.on_device()
                               ? coarse.shape.height
                               : int(std::max<std::size_t>(kBytesAtOnce / row_bytes, 1));
  for (int v = 0; v < coarse.shape.height; v += rows_at_once) {
    control_.throw_if_cancelled();
    const RowRange rows{v, std::min(v + rows_at_once, coarse.shape.height)};
    const RowRange fine_rows{2 * rows.begin, std::min(2 * rows.end, fine.shape.height)};
    const RowsOnDevice estimates = fine.estimates.open(fine_rows);
    const RowsOnDevice search = level_ > 0 ? fine.search.open(fine_rows) : RowsOnDevice();
    const RowsOnDevice out = coarse.search.open(rows);
    for (int i = 0; i < int(active_.size()); ++i)
      workspace_.coarsen_bounds(rows, {estimates, i}, {search, i}, {out, i});
    coarse.search.close(rows, out);
  }
}

void Pipeline::keep_searches() {
  LevelRows& search = levels_[level_].search;
  const std::size_t row_bytes = active_.size() * search.view_bytes();
  LevelSearch kept{shape(), RowStore(shape().height, row_bytes, plan_.work_folder)};
  std::vector<std::byte> row(row_bytes);
  for (int v = 0; v < shape().height; ++v) {
    const RowsOnDevice rows = search.open({v, v + 1});
    workspace_.read(*rows.memory, row, std::size_t(v - rows.begin) * row_bytes);
    kept.rows.write(v, 0, row_bytes, row.data());
  }
  searches_.push_back(std::move(kept));
}

void Pipeline::finish() {
  workspace_.begin_stage("fill");
  of_view_ = {};
  const LevelShape& finest = levels_.front().shape;
  maps_ = FinishedMaps(int(active_.size()), finest.width, finest.height, plan_.work_folder);
  std::vector<ViewMaps> filled;
  for (const LevelState& state : levels_) {
    const int width = state.shape.width;
    const RowRange all = state.shape.rows();
    filled.push_back({workspace_.make_map<float>(width, all),
                      workspace_.make_map<float>(width, all),
                      workspace_.make_map<std::int8_t>(width, all)});
  }
  StripMap<float> disparity(finest.width, finest.rows()), confidence = disparity;
  StripMap<std::int8_t> decided(finest.width, finest.rows());
  const FinishSteps finish_steps(workspace_);
  const auto bytes_of = [&](auto& map) {
    return std::as_writable_bytes(std::span(map.padded_row(0), map.pitch() * finest.rows().size()));
  };
  for (int i = 0; i < int(active_.size()); ++i) {
    control_.throw_if_cancelled();
    for (level_ = int(levels_.size()) - 1; level_ >= 0; --level_) {
      LevelState& state = levels_[level_];
      const RowRange all = state.shape.rows();
      std::vector<int> at{0};
      const ShownRows shown = level_ == 0 ? open_shown(all, {active_[i]}, at) : ShownRows{};
      workspace_.fill_view(all, state.shape, state.estimates.open_view(all, i),
                           level_ + 1 < int(levels_.size()) ? filled[level_ + 1] : ViewMaps{},
                           shown, at.front(), filled[level_]);
    }
    workspace_.read_later(filled[0].disparity.memory(), bytes_of(disparity));
    workspace_.read_later(filled[0].confidence.memory(), bytes_of(confidence));
    workspace_.read(filled[0].level.memory(), bytes_of(decided));
    maps_.put(i, disparity, confidence, decided);
  }
  take_fresh_tuples();
  level_ = int(levels_.size());
}

}  // namespace gigaray
