// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "decoded_pictures.h"
#include "gigaray/samplers/any_sampler.h"
#include "level_progress.h"
#include "level_rows.h"
#include "partition.h"
#include "run.h"
#include "sweep.h"

namespace gigaray {

/// What is kept of one level: of the partition's rows. Rows of all views (or of the active ones)
/// side by side, so that a band is one sequential read.
struct LevelState {
  LevelShape shape;
  LevelRows pixels;     ///< [v][view]: level 0 [u][3] as decoded, else [3][u] floats
  LevelRows mask;       ///< [v][active view][u]: worth trying; empty: everything is
  LevelRows estimates;  ///< [v][active view][u] PackedEstimate
  LevelRows bars;  ///< [v][active view][u] floats, see Workspace::set_bars; empty: no view has any
  LevelRows search;  ///< [v][active view][u] Search; empty at level 0
};

/// Walks the levels from fine to coarse, in each the views from the centre outwards, in each the
/// rows from top to bottom. The order of views and levels is fixed; a view is complete before the
/// next one starts. That makes the result independent of how many rows are done at once. It decides
/// what is done and looks at no pixel: those stay in the workspace. Of several partitions each
/// walks over its own rows; they go from view to view together (pipeline_exchange.cpp).
class Pipeline {
 public:
  /// rows: of every partition and level. result: for all partitions, and must outlive them.
  Pipeline(const Run& run, const std::vector<std::vector<PartitionRows>>& rows,
           DecodedPictures pictures, Workspace& workspace, RunResult& result);

  /// Once.
  void run(Partition& partition);

  TupleStore take_tuples() { return std::move(tuples_); }
  /// Of the host's work and the device's.
  std::map<std::string, double> seconds() const;

 private:
  /// Maps of the view that is worked on; all rows.
  struct Maps {
    Map<std::uint8_t> todo, grown_todo;  ///< grown: and what supports it
    Map<HypothesisBounds> bounds, grown_bounds;
    Map<float> disparity;  ///< Winners so far and what the view already has.
    Map<float> confidence, more_confidence;
    Map<float> smooth;    ///< Winners of a look after a median.
    Map<float> accepted;  ///< Estimates that the view keeps and gives to others.
    Map<Slope> slopes;
    Map<float> means;                       ///< along rays
    Map<std::uint8_t> beside, behind_todo;  ///< beside jumps, and what supports that
    Map<HypothesisBounds> behind_bounds;
    Map<float> evidence, side_confidence;  ///< of sides of jumps; with the first choice
    Map<std::uint8_t> scratch, more_scratch;
    Map<Radiance> radiance;
  };

  void begin_level();
  void make_maps();
  void find_edges_and_downsample();
  void find_edges(const std::vector<int>& views, RowRange band);
  void downsample(const std::vector<int>& views, RowRange band);
  void unpack_estimates(int active_idx, const Map<float>& disparity, const Map<float>& confidence);
  bool find_todo(int active_idx);
  /// Opening by a diamond that reaches `radius` px: 1, a cross of 3 px, removes isolated pixels and
  /// keeps lines of two. In one of the scratch maps; of radius 1 in more_scratch.
  const Map<std::uint8_t>& opened(int radius, const Map<std::uint8_t>& mask);
  void sweep(int active_idx);
  void run_stage(int active_idx, SweepStep step, RowRange rows, const std::vector<int>& done);
  void grow_todo();
  void score(int view, RowRange rows, ScoreViews views, const Map<std::uint8_t>& todo,
             const Map<HypothesisBounds>& bounds);
  /// From now on a volume holds these rows; what it has of them stays.
  void hold_scores(int volume, RowRange rows);
  /// Of those of the rows that a volume does not hold; then it holds `held`.
  void score_more(int volume, RowRange held, int view, RowRange rows, ScoreViews views,
                  const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds);
  /// Of all rows, whatever is held.
  void score_anew(int view, RowRange rows, ScoreViews views, const Map<std::uint8_t>& todo,
                  const Map<HypothesisBounds>& bounds);
  void look(int view, SweepStep step, RowRange rows);
  /// First row of the scores of the first look that the slanted one has not done with.
  int slanted_scores_begin() const;
  void support(int view, RowRange rows, const Map<std::uint8_t>& todo, bool along_slopes);
  void look_behind(int view, RowRange rows);
  void find_sides(int view, RowRange rows, const Map<float>& disparity);
  void choose_sides(int view, RowRange rows, const Map<float>& disparity,
                    const Map<float>& confidence, const Map<float>& chosen,
                    const Map<float>& chosen_confidence);
  /// Difference of hypotheses, on the finest level, that moves a point of a view by a pixel in the
  /// view that it moves most in.
  float way_of_a_pixel(int view) const;
  void take_winners(int view, RowRange rows, const Map<float>& winners, const Map<float>& contrast);
  void see_means(bool see);
  void accept(int active_idx, RowRange rows, bool anything);
  void propagate(int active_idx, RowRange band);
  void propagate_to_others(int active_idx);
  void clear_bars(int active_idx);
  void collect_tuples(int view);
  /// Those that were being read are there.
  void take_fresh_tuples();
  void coarsen();
  void finish();
  void keep_searches();

  /// Rows that this partition has to do with, of the level or of another one.
  const PartitionRows& rows() const { return rows_of(level_); }
  const PartitionRows& rows_of(int level) const { return rows_[partition_->index()][level]; }
  /// Do rays of a partition's own rows arrive in those alone?
  bool rays_stay() const { return rays_stay_[level_]; }
  bool do_rays_stay(int level) const;
  /// Rows of the reference view from where rays reach some rows.
  RowRange rows_reaching(int view, RowRange reached) const;
  /// Of some rows, those that other partitions have.
  template <class T>
  void bring_map(const Map<T>& map, RowRange wanted) {
    const std::size_t bytes = std::size_t(map_pitch(map.width())) * sizeof(T);
    partition_->bring(
        {rows().own, wanted, bytes,
         [&](RowRange part, std::byte* out) {
           workspace_.read(map.memory(), {out, part.size() * bytes}, part.begin * bytes);
         },
         [&](RowRange part, const std::byte* in) {
           workspace_.write(map.memory(), {in, part.size() * bytes}, part.begin * bytes);
         }});
  }
  void bring_rows(LevelRows& rows, int level, RowRange wanted);

  std::vector<RowRange> bands(RowRange rows) const;
  int count(const std::vector<int>& counts, RowRange rows) const;
  /// What the rays of the rows that a sweep is at need, and the rows around them; where memory does
  /// not hold that, of `rows`.
  void load_sweep(int view, RowRange rows, const std::vector<int>& done);
  /// Some rows of some views, as they are.
  void load_rows(const std::vector<int>& views, RowRange rows, bool masked);
  ShownRows open_shown(RowRange rows, const std::vector<int>& views, std::vector<int>& at);
  RowRange rows_needed(int view, RowRange rows) const;
  /// The views in groups that a band holds, for steps that look along no ray.
  std::vector<std::vector<int>> view_groups() const;
  bool is_last_level() const { return level_ + 1 == int(plan_.levels.size()); }
  LevelRows make_rows(RowRange rows, std::size_t views, std::size_t view_bytes) {
    return {workspace_, rows, int(views), view_bytes, plan_.place, plan_.work_folder};
  }
  const LevelShape& shape() const { return plan_.levels[level_].shape; }
  void report(double done);
  /// The part of the sweep that is enqueued.
  double sweep_share() const;
  double cost_of_sweep() const;
  /// Waits for what was enqueued at the last call, and reports that.
  void keep_pace(double sweep_share);
  /// A map of some rows alone; strips of different slots can be used together.
  template <class T>
  Map<T> strip(int slot, RowRange rows) {
    const std::size_t bytes = std::size_t(map_pitch(shape().width)) * rows.size() * sizeof(T);
    std::shared_ptr<Memory>& memory = strips_[slot];
    if (!memory || memory->bytes() < bytes) {
      memory.reset();
      memory = workspace_.allocate(bytes);
    }
    return {memory, shape().width, rows};
  }

  const LightField& light_field_;
  const DepthOptions& options_;
  const HypothesisRange hypotheses_;
  const MemoryPlan& plan_;
  const RunControl& control_;
  const CoarseGuide* guide_;
  const std::vector<std::vector<PartitionRows>>& rows_;
  DecodedPictures pictures_;
  Workspace& workspace_;
  RunResult& result_;
  Partition* partition_ = nullptr;
  AnySampler sampler_;

  const std::vector<int> active_;
  std::vector<LevelState> levels_;
  TupleStore tuples_;
  std::map<std::string, double> seconds_;  ///< of the host

  LevelRows shown_;  ///< level 0 [v][view][u]: 0 where a pixel shows nothing; empty: all do
  std::vector<bool> rays_stay_;             ///< by level
  std::vector<std::vector<int>> partners_;  ///< of every view

  int level_ = 0;
  Maps of_view_;
  std::vector<int> todo_counts_;  ///< pixels to do of the view that is worked on, by row
  RowRange loaded_sweep_;         ///< rows of a sweep that the loaded rows are for; empty: none
  std::vector<int> loaded_views_;
  bool loaded_masked_ = false;
  bool sees_means_ = false;           ///< means stand for the pixels of the view that is worked on
  std::vector<SweepStage> stages_;    ///< of the view that is worked on
  std::vector<RowRange> stage_rows_;  ///< that each of them does
  std::vector<int> progress_of_stages_;  ///< where each of them is
  std::size_t stage_at_work_ = 0;
  LevelProgress progress_;
  double paced_ = 0;  ///< part of the sweep that was enqueued at the last keep_pace()
  std::array<RowRange, 3> held_scores_;  ///< rows that volumes of scores hold
  std::array<std::shared_ptr<Memory>, 4> strips_;
  std::shared_ptr<Memory> tuple_memory_;
  std::vector<RayTuple> fresh_tuples_;  ///< being read
  const FinishSteps finish_steps_{workspace_};
};

}  // namespace gigaray
