// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gigaray/parallel.h"
#include "morphology.h"
#include "stage_timer.h"

namespace gigaray {

Pipeline::Pipeline(const LightField& light_field, const DepthOptions& options,
                   const HypothesisRange& hypotheses, const MemoryPlan& plan, Backend& backend,
                   const RunControl& control)
    : light_field_(light_field),
      options_(options),
      hypotheses_(hypotheses),
      plan_(plan),
      backend_(backend),
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
  backend_.set_active_views(active_);
  for (level_ = 0; level_ < int(plan_.levels.size()); ++level_) {
    begin_level(level_);
    find_edges_and_downsample();
    for (int i = 0; i < int(active_.size()); ++i) {
      report(double(i) / double(active_.size()));
      ViewMaps maps;
      if (!find_todo(i, maps)) continue;
      score_view(active_[i], maps);
      accept_view(i, maps);
    }
    if (!is_last_level()) coarsen();
    levels_[level_].pixels = RowStore();
  }
  report(0);
}

void Pipeline::report(double done) {
  // A level has a quarter of the pixels of the level before: its share of the work.
  const double before = 1 - std::pow(0.25, level_), share = 0.75 * std::pow(0.25, level_);
  const bool finished = level_ >= int(plan_.levels.size());
  control_.progress(finished ? "depth" : "level " + std::to_string(level_),
                    finished ? 1 : before + share * done, 1);
}

// ---- Pixels -------------------------------------------------------------------------------------

void Pipeline::decode() {
  const StageTimer timer(seconds_, "decode");
  const int height = light_field_.height;
  const std::size_t width = light_field_.width;
  const std::size_t value_bytes = light_field_.pixels->bit_depth() / 8;
  const std::size_t line = std::size_t(width) * 3;
  RowStore& pixels = levels_[0].pixels;

  const int views = light_field_.num_views();
  control_.progress("decode", 0, views);
  const auto decode_view = [&](int view) {
    Image<std::uint16_t> picture = read_view(light_field_, view);
    light_field_.pixels->let_go(view);
    if (const auto mask = take_mask(picture))
      for (int v = 0; v < height; ++v) mask_.write(v, view * width, width, mask->row(v));
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
}

void Pipeline::begin_level(int level) {
  const LevelShape& shape = plan_.levels[level].shape;
  const std::size_t views = light_field_.num_views(), active = active_.size(), width = shape.width;
  if (level == 0) {
    LevelState state;
    state.shape = shape;
    state.pixels =
        make_store(shape.height, views * width * 3 * (light_field_.pixels->bit_depth() / 8));
    levels_.push_back(std::move(state));
    if (light_field_.pixels->has_mask()) mask_ = make_store(shape.height, views * width);
    decode();
  }
  LevelState& state = levels_[level];
  state.estimates = make_store(shape.height, active * width * sizeof(PackedEstimate));
  if (options_.edge.threshold >= 0 && !is_last_level())
    state.mask = make_store(shape.height, active * width);
  if (!is_last_level()) {
    LevelState next;
    next.shape = plan_.levels[level + 1].shape;
    next.pixels = make_store(next.shape.height, views * 3 * next.shape.width * sizeof(float));
    next.search = make_store(next.shape.height, active * next.shape.width * sizeof(Search));
    levels_.push_back(std::move(next));
  }
  backend_.begin_level(shape);
  loaded_band_ = loaded_rows_ = {};
  loaded_views_.clear();
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
        return sampler.at_level(level_).rows_needed(view, rows, hypotheses_,
                                                    plan_.levels[level_].shape.height);
      },
      sampler_);
}

void Pipeline::load_band(int view, RowRange band) {
  const LevelPlan& plan = plan_.levels[level_];
  const RowRange own_rows = grown(band, plan.halo, plan.shape.height);
  if (band == loaded_band_ && partners_[view] == loaded_views_) return;
  load_rows(partners_[view], rows_needed(view, own_rows), true);
  loaded_band_ = band;
  if (means_) backend_.replace_reference(own_rows, *means_);
}

void Pipeline::load_rows(const std::vector<int>& views, RowRange rows, bool masked) {
  control_.throw_if_cancelled();
  masked = masked && !mask_.empty();
  if (rows == loaded_rows_ && views == loaded_views_ && masked == loaded_masked_) return;
  const StageTimer timer(seconds_, "load");
  loaded_band_ = {};
  const int width = plan_.levels[level_].shape.width;
  const std::size_t all = light_field_.views.size(), count = views.size();
  const BandEncoding encoding = level_ > 0                              ? BandEncoding::kFloat
                                : light_field_.pixels->bit_depth() == 8 ? BandEncoding::kBits8
                                                                        : BandEncoding::kBits16;
  RowStore& pixels = levels_[level_].pixels;
  const std::size_t view_bytes = pixels.row_bytes() / all;
  const std::byte* encoded = nullptr;
  if (count == all) {
    encoded = pixels.open(rows, band_scratch_);
  } else {
    band_scratch_.at_least(rows.size() * count * view_bytes);
    std::byte* out = band_scratch_.data();
    for (int v = rows.begin; v < rows.end; ++v)
      for (const int view : views) {
        pixels.read(v, view * view_bytes, view_bytes, out);
        out += view_bytes;
      }
    encoded = band_scratch_.data();
  }
  const std::uint8_t* mask = nullptr;
  if (masked) {
    mask_scratch_.at_least(rows.size() * count * width);
    auto* out = reinterpret_cast<std::uint8_t*>(mask_scratch_.data());
    mask = out;
    std::vector<std::uint8_t> line(light_field_.width);
    for (int v = rows.begin; v < rows.end; ++v)
      for (const int view : views) {
        mask_.read(v << level_, view * line.size(), line.size(), line.data());
        for (int u = 0; u < width; ++u) *out++ = line[std::size_t(u) << level_];
      }
  }
  backend_.load_band(rows, views, encoded, encoding, mask);
  loaded_rows_ = rows;
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
  if (state.mask.empty() && is_last_level()) return;
  const LevelPlan& plan = plan_.levels[level_];
  for (const RowRange band : bands())
    for (const std::vector<int>& group : view_groups()) {
      RowRange rows = grown(band, plan.halo, plan.shape.height);
      // All views in one group: what is loaded serves the rays of the first view too.
      if (group.size() == light_field_.views.size()) rows = rows_needed(active_.front(), rows);
      load_rows(group, rows, false);
      if (!state.mask.empty()) find_edges(group, band);
      if (!is_last_level()) downsample(group, band);
    }
}

void Pipeline::find_edges(const std::vector<int>& views, RowRange band) {
  const StageTimer timer(seconds_, "edges");
  LevelState& state = levels_[level_];
  const int width = state.shape.width, height = state.shape.height;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (!std::binary_search(views.begin(), views.end(), active_[i])) continue;
    const RowRange around = grown(band, options_.edge.opening ? 2 : 0, height);
    StripMap<float> confidence(width, around);
    backend_.edge_confidence(active_[i], around, confidence);
    StripMap<std::uint8_t> mask(width, around);
    for (int v = around.begin; v < around.end; ++v)
      for (int u = 0; u < width; ++u)
        mask.row(v)[u] = confidence.row(v)[u] > options_.edge.threshold;
    if (options_.edge.opening) mask = open_mask(mask, band, height);
    for (int v = band.begin; v < band.end; ++v) state.mask.write(v, i * width, width, mask.row(v));
  }
}

void Pipeline::downsample(const std::vector<int>& views, RowRange band) {
  const StageTimer timer(seconds_, "downsample");
  LevelState& next = levels_[level_ + 1];
  const RowRange small{(band.begin + 1) / 2, (band.end + 1) / 2};
  if (small.size() == 0) return;
  const std::size_t view_bytes = next.pixels.row_bytes() / light_field_.views.size();
  AlignedBytes scratch(small.size() * views.size() * view_bytes);
  backend_.downsample(small, reinterpret_cast<float*>(scratch.data()));
  // A group is a run of views: its rows are one piece.
  for (int v = small.begin; v < small.end; ++v)
    next.pixels.write(v, views.front() * view_bytes, views.size() * view_bytes,
                      scratch.data() + (v - small.begin) * views.size() * view_bytes);
}

// ---- Views --------------------------------------------------------------------------------------

bool Pipeline::find_todo(int active_idx, ViewMaps& maps) {
  if (partners_[active_[active_idx]].size() < 2) return false;  // nothing to compare with
  const StageTimer timer(seconds_, "select");
  LevelState& state = levels_[level_];
  const int width = state.shape.width, height = state.shape.height;
  const RowRange all{0, height};
  maps.todo = StripMap<std::uint8_t>(width, all);
  maps.bounds = StripMap<HypothesisBounds>(width, all);
  maps.disparity = StripMap<float>(width, all);
  maps.confidence = StripMap<float>(width, all);

  const HypothesisBounds full{0, std::uint16_t(hypotheses_.count - 1)};
  const std::size_t at = std::size_t(active_idx) * width;
  std::vector<PackedEstimate> estimates(width);
  bool any_known = false;
  for (int v = 0; v < height; ++v) {
    state.estimates.read(v, at * sizeof(PackedEstimate), width * sizeof(PackedEstimate),
                         estimates.data());
    for (int u = 0; u < width; ++u) {
      maps.disparity.row(v)[u] = hypothesis_of(estimates[u]);
      maps.confidence.row(v)[u] = estimates[u] != 0 ? confidence_of(estimates[u]) : 0;
      any_known = any_known || estimates[u] != 0;
    }
  }
  const bool cracked = level_ == 0 && any_known && options_.propagation.crack_width > 0;
  if (cracked) fill_cracks(active_idx, maps);

  std::vector<std::uint8_t> mask(width, 1), shown(mask_.empty() ? 0 : light_field_.width);
  std::vector<Search> search(width);
  for (int v = 0; v < height; ++v) {
    if (!shown.empty())
      mask_.read(v << level_, active_[active_idx] * shown.size(), shown.size(), shown.data());
    if (!state.mask.empty()) state.mask.read(v, at, width, mask.data());
    if (level_ > 0)
      state.search.read(v, at * sizeof(Search), width * sizeof(Search), search.data());
    for (int u = 0; u < width; ++u) {
      if (!std::isnan(maps.disparity.row(v)[u]) || !mask[u]) continue;
      if (!shown.empty() && !shown[std::size_t(u) << level_]) continue;
      if (level_ > 0 && std::isnan(search[u].low)) continue;
      maps.todo.row(v)[u] = 1;
      maps.bounds.row(v)[u] = level_ > 0 ? bounds_of(search[u], hypotheses_) : full;
    }
  }
  if (cracked) bound_thin_holes(maps.todo, maps.disparity, hypotheses_, maps.bounds);
  // Specks would cost whole windows of scores each.
  if (cracked && !is_last_level()) maps.todo = open_mask(maps.todo, all, height);
  return any_set(maps.todo, all);
}

void Pipeline::fill_cracks(int active_idx, ViewMaps& maps) {
  constexpr float kSameSurface = 3;  // hypotheses
  const StripMap<std::uint8_t> filled =
      close_cracks(options_.propagation.crack_width, kSameSurface * float(hypotheses_.step()),
                   maps.disparity, maps.confidence);
  LevelState& state = levels_[level_];
  const std::size_t at = std::size_t(active_idx) * state.shape.width;
  for (int v = 0; v < state.shape.height; ++v)
    for (int u = 0; u < state.shape.width; ++u) {
      if (!filled.row(v)[u]) continue;
      const PackedEstimate estimate =
          pack_estimate(maps.disparity.row(v)[u], maps.confidence.row(v)[u]);
      state.estimates.write(v, (at + u) * sizeof(PackedEstimate), sizeof estimate, &estimate);
    }
}

void Pipeline::accept_view(int active_idx, ViewMaps& maps) {
  LevelState& state = levels_[level_];
  const int width = state.shape.width, view = active_[active_idx];
  const float threshold =
      is_last_level() ? -std::numeric_limits<float>::infinity() : options_.winner.min_confidence;
  for (const RowRange band : bands()) {
    if (!any_set(maps.todo, band)) continue;
    load_band(view, band);
    StripMap<float> accepted(width, band);
    if (options_.winner.median_radius > 0) {
      const StageTimer timer(seconds_, "median");
      backend_.bilateral_median(view, band, options_.winner.median_radius,
                                options_.winner.median_tolerance, maps.disparity, accepted);
    } else {
      for (int v = band.begin; v < band.end; ++v)
        std::copy_n(maps.disparity.row(v), width, accepted.row(v));
    }
    for (int v = band.begin; v < band.end; ++v)
      for (int u = 0; u < width; ++u)
        if (!maps.todo.row(v)[u] || !(maps.confidence.row(v)[u] > threshold))
          accepted.row(v)[u] = kNoEstimate;

    StripMap<Radiance> radiance(width, band);
    {
      const StageTimer timer(seconds_, "radiance");
      backend_.mean_radiance(view, band, accepted, radiance);
    }
    const StageTimer timer(seconds_, "propagate");
    for (int v = band.begin; v < band.end; ++v)
      for (int u = 0; u < width; ++u)
        if (const float h = accepted.row(v)[u]; !std::isnan(h))
          tuples_.append({h, maps.confidence.row(v)[u], radiance.row(v)[u], view, u, v, level_});
    const RowRange reached = rows_needed(view, band);
    std::byte* estimates = state.estimates.open(reached, state_scratch_);
    backend_.propagation(view, band, accepted, maps.confidence, radiance, reached, active_idx,
                         reinterpret_cast<PackedEstimate*>(estimates));
    state.estimates.close(reached, estimates);
  }
}

void Pipeline::coarsen() {
  const StageTimer timer(seconds_, "bounds");
  const LevelState& fine = levels_[level_];
  LevelState& coarse = levels_[level_ + 1];
  const std::size_t width = fine.shape.width, small = coarse.shape.width, active = active_.size();
  AlignedBytes estimate_scratch, search_scratch;
  std::vector<PackedEstimate> estimates(2 * width);
  std::vector<Search> search(level_ > 0 ? 2 * width : 0), row(small);
  for (int v = 0; v < coarse.shape.height; ++v) {
    control_.throw_if_cancelled();
    const RowRange rows{2 * v, std::min(2 * v + 2, fine.shape.height)};
    const auto* all_estimates =
        reinterpret_cast<const PackedEstimate*>(fine.estimates.open(rows, estimate_scratch));
    const Search* all_search =
        level_ > 0 ? reinterpret_cast<const Search*>(fine.search.open(rows, search_scratch))
                   : nullptr;
    for (std::size_t i = 0; i < active; ++i) {
      for (int y = 0; y < rows.size(); ++y) {
        const std::size_t at = (std::size_t(y) * active + i) * width;
        std::copy_n(all_estimates + at, width, estimates.begin() + y * width);
        if (all_search) std::copy_n(all_search + at, width, search.begin() + y * width);
      }
      coarsen_bounds(std::span(estimates).first(rows.size() * width),
                     std::span(search).first(all_search ? rows.size() * width : 0), int(width),
                     hypotheses_, row);
      coarse.search.write(v, i * small * sizeof(Search), small * sizeof(Search), row.data());
    }
  }
}

}  // namespace gigaray
