// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kernels/kernel_params.h"
#include "opencl/kernel_set.h"
#include "opencl/lane_kernel.h"
#include "opencl/opencl_workspace.h"
#include "opencl/sampler_twin.h"
#include "src/band_ring.h"
#include "src/workspace.h"

namespace gigaray::opencl {

/// A Workspace on an OpenCL device. Memory and pixels: device_workspace.cpp, scores:
/// device_scores.cpp, maps of the reference view: device_maps.cpp, estimates of all active views:
/// device_estimates.cpp.
class DeviceWorkspace : public Workspace {
 public:
  /// With a queue of its own on the device.
  DeviceWorkspace(SamplerTwin sampler, const WorkspaceSetup& setup, const Device& device,
                  TuningOverrides overrides);

  std::string name() const override { return "opencl"; }
  std::string description() const override;
  std::shared_ptr<Memory> allocate(std::size_t bytes) override;
  std::shared_ptr<Memory> adopt(std::span<std::byte> host) override;
  void write(Memory& memory, std::span<const std::byte> data, std::size_t offset) override;
  void read(const Memory& memory, std::span<std::byte> data, std::size_t offset) override;
  void read_later(const Memory& memory, std::span<std::byte> data, std::size_t offset) override;
  std::span<std::byte> map(Memory& memory, bool to_fill) override;
  void unmap(Memory& memory, std::span<std::byte> mapped) override;
  void finish() override;
  void keep_pace() override;
  bool shares_host_memory() const override { return device_.info().shares_host_memory; }
  const Traffic& traffic() const override { return traffic_; }
  void begin_stage(const std::string& stage) override { device_.log()->begin_stage(stage); }
  const std::map<std::string, double>& seconds() const override { return device_.log()->seconds(); }

  void set_active_views(const std::vector<int>& views) override;
  void begin_level(const LevelShape& shape, int band_rows) override;
  RowRange missing_rows(RowRange rows, const std::vector<int>& views) const override {
    return views == loaded_views_ ? ring_.missing(rows) : rows;
  }
  void load_band(RowRange rows, RowRange fresh, const std::vector<int>& views,
                 const EncodedRows& source) override;
  void downsample(RowRange small_rows, const RowsOnDevice& small, int first) override;
  int channels() const override { return setup_.options.score.gradient ? 5 : 3; }
  void ray_mean(int ref, RowRange rows, const Map<std::uint8_t>& wanted,
                const Map<float>& disparity, const Map<float>& means) override;
  void mean_gradients(RowRange rows, const Map<float>& means) override;
  void replace_reference(const Map<float>& means) override { means_ = means; }
  void restore_reference() override { means_ = {}; }

  void edge_confidence(int ref, RowRange rows, const Map<float>& strip) override;
  void edge_mask(RowRange rows, const Map<float>& strip, float threshold,
                 const Map<std::uint8_t>& mask) override;
  void erode(RowRange rows, const Map<std::uint8_t>& in, const Map<std::uint8_t>& out) override;
  void dilate(RowRange rows, const Map<std::uint8_t>& in, const Map<std::uint8_t>& out) override;
  void put_mask(RowRange rows, const Map<std::uint8_t>& mask, const ViewRows& to) override;
  void unpack_estimates(RowRange rows, const ViewRows& estimates, const Map<float>& disparity,
                        const Map<float>& confidence) override;
  void close_cracks(RowRange rows, int width, float apart, const Map<float>& disparity,
                    const Map<float>& confidence, const Map<float>& closed,
                    const Map<float>& closed_confidence, const ViewRows& estimates) override;
  void select_todo(RowRange rows, const Map<float>& disparity, const ViewRows& mask,
                   const ShownRows& shown, int shown_at, const ViewRows& search,
                   const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds) override;
  void bound_thin_holes(RowRange rows, const Map<std::uint8_t>& todo, const Map<std::uint8_t>& wide,
                        const Map<float>& estimates, const Map<HypothesisBounds>& bounds) override;
  void grow_todo(RowRange rows, int radius, const Map<std::uint8_t>& todo,
                 const Map<HypothesisBounds>& bounds, const Map<std::uint8_t>& grown_todo,
                 const Map<HypothesisBounds>& grown_bounds) override;
  void beside_jumps(RowRange rows, const Map<float>& map, float jump, int reach,
                    const Map<std::uint8_t>& todo, const Map<std::uint8_t>& beside) override;
  std::vector<int> count_rows(const Map<std::uint8_t>& mask) override;
  std::vector<int> count_estimates(const Map<float>& estimates) override;

  void hold_scores(int volume, RowRange rows) override;
  void density_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                     const Map<HypothesisBounds>& bounds) override;
  void robust_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                    const Map<HypothesisBounds>& bounds, ScoreViews views) override;
  void score_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                     const Map<HypothesisBounds>& bounds) override;
  void slanted_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                       const Map<HypothesisBounds>& bounds, const Map<Slope>& slopes) override;
  void scanline(int ref, RowRange rows, const Map<std::uint8_t>& todo) override;
  std::vector<float> scores_at(int u, int v) override;

  void winner(RowRange rows, const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds,
              const Map<float>& disparity, const Map<float>& contrast) override;
  void score_of_estimate(RowRange rows, const Map<std::uint8_t>& todo, const Map<float>& disparity,
                         const Map<float>& scores) override;
  void take_winners(RowRange rows, bool is_last_level, const Map<std::uint8_t>& todo,
                    const Map<HypothesisBounds>& bounds, const Map<float>& winners,
                    const Map<float>& contrast, const Map<float>& best, const Map<float>& edges,
                    const Map<float>& disparity, const Map<float>& confidence) override;
  void step_back(RowRange rows, float farther, const Map<float>& winners,
                 const Map<float>& contrast, const Map<float>& best, const Map<float>& own,
                 const Map<float>& disparity, const Map<float>& confidence) override;
  void side_evidence(int ref, RowRange rows, float jump, const Map<std::uint8_t>& todo,
                     const Map<float>& disparity, const Map<float>& evidence) override;
  void choose_sides(int ref, RowRange rows, float jump, const Map<float>& disparity,
                    const Map<float>& confidence, const Map<float>& evidence,
                    const Map<float>& chosen, const Map<float>& chosen_confidence) override;
  void find_hidden(int ref, RowRange rows, float apart, const Map<std::uint8_t>& todo,
                   const Map<float>& disparity, const Map<float>& confidence,
                   const Map<std::uint8_t>& hidden) override;
  void find_specks(RowRange rows, float apart, const Map<std::uint8_t>& todo,
                   const Map<float>& disparity, const Map<std::uint8_t>& hidden,
                   const Map<std::uint8_t>& guessed) override;
  void fill_hidden(RowRange rows, float apart, const Map<std::uint8_t>& guessed,
                   const Map<float>& disparity, const Map<float>& confidence) override;
  void bilateral_median(int ref, RowRange rows, int radius, float tolerance, const Map<float>& in,
                        const Map<float>& out) override;
  void slope_fit(int ref, RowRange rows, const Map<std::uint8_t>& todo, const Map<float>& in,
                 const Map<Slope>& slopes) override;
  void accept(RowRange rows, float threshold, const Map<std::uint8_t>& todo,
              const Map<float>& confidence, const Map<float>& estimates) override;
  void mean_radiance(int ref, RowRange rows, const Map<float>& disparity,
                     const Map<Radiance>& radiance) override;
  int compact_tuples(int view, RowRange rows, const Map<float>& disparity,
                     const Map<float>& confidence, const Map<Radiance>& radiance,
                     Memory& tuples) override;

  void set_bars(int ref, RowRange rows, const Map<float>& disparity, RowRange reached, int finished,
                const RowsOnDevice& estimates, const RowsOnDevice& bars) override;
  void propagation(int ref, RowRange rows, const Map<float>& disparity,
                   const Map<float>& confidence, const Map<Radiance>& radiance, RowRange reached,
                   int finished, const RowsOnDevice& bars, const RowsOnDevice& estimates) override;
  void clear_bars(int ref, RowRange rows, const Map<float>& disparity, RowRange reached,
                  int finished, const RowsOnDevice& bars) override;
  void coarsen_bounds(RowRange rows, const ViewRows& estimates, const ViewRows& search,
                      const ViewRows& coarse) override;
  void fill_view(RowRange rows, const LevelShape& shape, const ViewRows& estimates,
                 const ViewMaps& coarse, const ShownRows& shown, int shown_at,
                 const ViewMaps& maps) override;

 private:
  class DeviceMemory;
  /// Of a handle that may be empty: then a buffer that a kernel gets and does not look at.
  const Buffer& buffer_of(const Memory* memory) const;
  template <class T>
  const Buffer& buffer_of(const Map<T>& map) const {
    return buffer_of(map ? &map.memory() : nullptr);
  }
  const Buffer& buffer_of(const RowsOnDevice& rows) const { return buffer_of(rows.memory.get()); }
  const Buffer& buffer_of(const ViewRows& view) const { return buffer_of(view.rows); }
  const Buffer& buffer_of(const Scratch& scratch) const { return scratch.buffer; }

  /// Where the pixels of the reference view are, for kernels that look at nothing else.
  struct OwnPixels {
    const Buffer& buffer;
    BandParams band;
    int view;
  };
  OwnPixels reference_pixels(int ref) const;
  OwnPixels pixels_of(const Map<float>& means) const;

  /// Members of a ScoreViews, for one reference view.
  struct ViewSet {
    Buffer buffer;
    int used = 0;
  };
  const ViewSet& view_set(int ref, ScoreViews views);

  /// `view`: a view of the light field. OwnPixels::view goes into own_strip() instead.
  StripParams strip(int view, RowRange rows) const;
  StripParams own_strip(int place, RowRange rows) const {
    return {place, band_.width, rows.begin, rows.end, band_.stride};
  }
  StripParams strip(RowRange rows) const { return own_strip(0, rows); }

  std::size_t volume_bytes(RowRange rows) const;
  /// Byte where a row of a volume begins.
  std::size_t score_offset(int row) const;
  void winner_reads(Scratch& scores, RowRange rows);
  int least_views(int used) const;
  /// Samples from taps know masked pixels anyway.
  std::string masked_define() const {
    return is_masked_ && all_views_.rays_shift_alike ? define("MASKED", 1) : "";
  }
  /// What the files of kernels are built with.
  std::string score_defines() const;
  std::string density_defines() const;
  std::string robust_defines(bool half_planes) const;
  std::string edge_defines() const;
  std::string support_defines() const;
  std::string sides_defines() const;
  std::string winner_defines() const;
  static std::string median_defines(int radius, bool bilateral);
  std::string arrival_defines() const;
  /// Those of a run with the workspace's options.
  std::vector<KernelFile> usual_files() const;
  /// From now on the band holds these views.
  void see_views(const std::vector<int>& views);
  template <class T>
  Buffer upload(const std::vector<T>& values) {
    traffic_.bytes_up += values.size() * sizeof(T);
    ++traffic_.waits;
    return Buffer(device_, std::span<const T>(values));
  }
  /// The twin's table for rays of `ref`.
  Buffer& rays(int ref);
  /// How kernels find samples: shifts from `ref` to all views under all hypotheses, or the table.
  Buffer& ways(int ref);
  /// Where kernels find samples.
  Buffer& samples() { return all_views_.rays_shift_alike ? band_memory_.buffer : taps_.buffer; }

  Kernel& plain_kernel(const std::string& file, const std::string& entry,
                       const std::string& options = "") {
    return kernels_.plain(file, entry, options);
  }
  LaneKernel& lane_kernel(const std::string& file, const std::string& options,
                          const std::string& entry = "", std::size_t vectors = 0) {
    return kernels_.lanes(file, options, entry, vectors);
  }
  /// A kernel of kMapSteps with a work-item per pixel, or per row.
  template <class... Args>
  void run_pixels(const std::string& entry, RowRange rows, const Args&... args) {
    constexpr std::size_t kGroup = 64;
    plain_kernel(kMapSteps, entry, real_define())
        .set_args(strip(rows), args...)
        .run(WorkSize(round_up(band_.width, kGroup), rows.size()), WorkSize(kGroup, 1));
  }
  template <class... Args>
  void run_rows(const std::string& entry, RowRange rows, const Args&... args) {
    constexpr std::size_t kGroup = 8;
    plain_kernel(kMapSteps, entry, real_define())
        .set_args(strip(rows), args...)
        .run(WorkSize(round_up(rows.size(), kGroup)), WorkSize(kGroup));
  }
  std::string real_define() const { return define("FP64", device_.info().has_fp64); }
  /// The same; after the strip the kernel takes the hypotheses in the precision of the host.
  template <class... Args>
  void run_with_reals(const std::string& entry, RowRange rows, const Args&... args);
  /// Exclusive sums of counts[0, rows), their total behind them.
  void sum_counts(int rows, Buffer& counts);
  std::vector<int> count(const std::string& entry, const Buffer& map);
  /// A kernel of propagation.cl and its work-items.
  Kernel& arrival_kernel(const std::string& entry);
  void run_arrivals(Kernel& kernel, RowRange rows);

  SamplerTwin all_views_;
  SamplerTwin band_views_;  ///< of the level and the loaded views
  WorkspaceSetup setup_;
  Device device_;
  KernelSet kernels_;
  std::vector<float> table_;
  HypothesisParams hypotheses_{};
  BandRing ring_;
  BandParams band_{};
  int level_ = 0;
  std::vector<int> active_views_, loaded_views_;
  std::vector<int> places_;  ///< of all views among loaded_views_
  bool is_masked_ = false;   ///< some pixels of the band may be
  int shifts_ref_ = -1;      ///< the view that shifts_ are for
  RowRange score_rows_;
  /// Scores as they come, and of which rows.
  struct RawScores {
    Scratch scores;
    RowRange rows;
  };
  std::array<RawScores, 3> volumes_;
  RawScores* raw_ = volumes_.data();  ///< that steps work on
  Scratch* winner_scores_ = nullptr;  ///< the scores of score_rows_
  Scratch* chosen_by_ = nullptr;      ///< path_scores_ after a scan-line step, else the scores
  Map<float> means_;                  ///< stand for the reference view; empty: they don't
  Traffic traffic_;
  cl::Event pace_;  ///< of the last keep_pace()

  Buffer table_buffer_, active_buffer_, at_buffer_;
  std::vector<int> at_;  ///< what at_buffer_ holds
  /// By reference view, for the views of the band.
  std::map<int, Buffer> rays_;
  std::map<std::pair<ScoreViews, int>, ViewSet> view_sets_;
  Scratch shifts_, together_, lonely_, packed_, counts_, jumps_, near_, grown_, grown_bounds_,
      intervals_, band_memory_, taps_, supported_scores_, path_scores_;
};

}  // namespace gigaray::opencl
