// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gigaray/reconstruct.h"
#include "gigaray/samplers/any_sampler.h"
#include "memory_plan.h"
#include "row_store.h"
#include "search_bounds.h"
#include "tuple_store.h"

namespace gigaray {

/// What is kept of one level. Rows of all views (or of the active ones) side by side, so that a
/// band is one sequential read.
struct LevelState {
  LevelShape shape;
  RowStore pixels;     ///< [v][view]: level 0 [u][3] as decoded, else [3][u] floats
  RowStore mask;       ///< [v][active view][u]: worth trying; empty: everything is
  RowStore estimates;  ///< [v][active view][u] PackedEstimate
  RowStore bars;       ///< [v][active view][u] floats, see raise_bars(); empty: no view has any
  RowStore search;     ///< [v][active view][u] Search; empty at level 0
};

/// Walks the levels from fine to coarse, in each the views from the centre outwards, in each the
/// bands from top to bottom. The order of views and levels is fixed; a view is complete before the
/// next one starts. That makes the result independent of the bands.
class Pipeline {
 public:
  Pipeline(const LightField& light_field, const DepthOptions& options,
           const HypothesisRange& hypotheses, const MemoryPlan& plan, Backend& backend,
           const RunControl& control);

  void run();

  std::vector<LevelState>& levels() { return levels_; }
  RowStore& mask() { return mask_; }
  const std::vector<int>& active_views() const { return active_; }
  TupleStore& tuples() { return tuples_; }
  std::map<std::string, double>& seconds() { return seconds_; }

 private:
  /// Maps of the view that is worked on; all rows.
  struct ViewMaps {
    StripMap<std::uint8_t> todo;
    StripMap<HypothesisBounds> bounds;
    StripMap<float> disparity;  ///< Winners of this pass and what the view already has.
    StripMap<float> confidence;
  };

  /// One look at the pixels to do, with what was learned from the one before.
  struct ScorePass {
    StripMap<std::uint8_t> todo;
    StripMap<std::uint8_t> score_todo;  ///< and what supports them
    StripMap<HypothesisBounds> score_bounds;
    const StripMap<Slope>* slopes = nullptr;  ///< null: support without slopes
    ScoreViews views = ScoreViews::kAll;
    bool scanline = false;
  };
  ScorePass make_pass(const StripMap<std::uint8_t>& todo, const ViewMaps& maps);

  void decode();
  void begin_level(int level);
  void find_edges_and_downsample();
  void find_edges(const std::vector<int>& views, RowRange band);
  void downsample(const std::vector<int>& views, RowRange band);
  bool find_todo(int active_idx, ViewMaps& maps);
  void fill_cracks(int active_idx, ViewMaps& maps);
  void score_view(int view, ViewMaps& maps);
  void look_behind(int view, const StripMap<Slope>& slopes, const StripMap<float>& smooth,
                   ViewMaps& maps);
  void see_means(const StripMap<float>* means);
  void score_strips(int view, const ScorePass& pass, ViewMaps& maps);
  void score_strip(int view, RowRange rows, const ScorePass& pass, ViewMaps& maps);
  void take_winners(int view, RowRange rows, const ScorePass& pass, ViewMaps& maps);
  void step_back(RowRange rows, const ScorePass& pass, ViewMaps& maps);
  StripMap<float> smooth_disparity(int view, const ViewMaps& maps);
  StripMap<float> ray_means(int view, const ScorePass& pass, const StripMap<float>& smooth);
  StripMap<Slope> fit_slopes(int view, const StripMap<std::uint8_t>& todo,
                             const StripMap<float>& smooth);
  void accept_view(int active_idx, ViewMaps& maps);
  /// The view is finished: from now on what arrives in it must lead (finished_lead).
  void raise_bars(int active_idx);
  void coarsen();

  std::vector<RowRange> bands() const;
  /// What the rays of some rows of a view need, and the rows around them.
  void load_band(int view, RowRange band);
  /// Some rows of some views, as they are.
  void load_rows(const std::vector<int>& views, RowRange rows, bool masked);
  RowRange rows_needed(int view, RowRange rows) const;
  /// The views in groups that a band holds, for steps that look along no ray.
  std::vector<std::vector<int>> view_groups() const;
  bool is_last_level() const { return level_ + 1 == int(plan_.levels.size()); }
  RowStore make_store(int rows, std::size_t row_bytes) const {
    return RowStore(rows, row_bytes, plan_.work_folder);
  }
  void report(double done);

  const LightField& light_field_;
  const DepthOptions& options_;
  const HypothesisRange hypotheses_;
  const MemoryPlan& plan_;
  Backend& backend_;
  const RunControl& control_;
  AnySampler sampler_;

  std::vector<int> active_;  ///< views that get depth, from the centre outwards
  std::vector<LevelState> levels_;
  TupleStore tuples_;
  std::map<std::string, double> seconds_;

  RowStore mask_;  ///< level 0 [v][view][u]: 0 where a pixel shows nothing; empty: all do
  std::vector<std::vector<int>> partners_;  ///< of every view

  int level_ = 0;
  RowRange loaded_band_;  ///< that the loaded rows are for; empty: none
  RowRange loaded_rows_;
  std::vector<int> loaded_views_;
  bool loaded_masked_ = false;
  const StripMap<float>* means_ = nullptr;  ///< stand for the pixels of the view that is worked on
  RowRange scored_rows_;  ///< what the backend has raw scores of, for the view that is worked on
  AlignedBytes band_scratch_, mask_scratch_, state_scratch_, bar_scratch_;
};

}  // namespace gigaray
