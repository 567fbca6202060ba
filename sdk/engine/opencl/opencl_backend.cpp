// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <map>

#include "gigaray/samplers/any_sampler.h"
#include "kernels/kernel_params.h"
#include "opencl/kernel_set.h"
#include "opencl/lane_kernel.h"
#include "opencl/opencl_backend.h"
#include "opencl/sampler_twin.h"
#include "src/band_views.h"

namespace gigaray {
namespace {

using opencl::Buffer;
using opencl::define;
using opencl::Kernel;
using opencl::kStagedVectors;
using opencl::LaneKernel;
using opencl::LocalMemory;
using opencl::pack_sparse_blocks;
using opencl::round_up;
using opencl::SamplerTwin;
using opencl::Scratch;
using opencl::twin_of;
using opencl::WorkSize;

static_assert(StripMap<float>::kPad == GIGARAY_PAD);
static_assert(kScanlineBlock == SCANLINE_BLOCK && kScanlineReach == SCANLINE_REACH);

/// Lanes never reach beyond this many hypotheses of a pixel.
constexpr int kWidestLanes = 16;
/// Floats beside the states of a scan-line, see scanline.cl.
constexpr int kScanlineMargin = 16;

class OpenClBackend : public Backend {
 public:
  OpenClBackend(SamplerTwin sampler, const BackendSetup& setup, const std::string& selection,
                opencl::TuningOverrides overrides)
      : all_views_(std::move(sampler)),
        setup_(setup),
        device_(opencl::Device::open(selection)),
        kernels_(
            device_, all_views_.kernel_file,
            define("CHANNELS", channels()) + define("SHIFT_ALIKE", all_views_.rays_shift_alike),
            all_views_.num_views, std::move(overrides)),
        table_(colour_table(setup.bit_depth, setup.options.score.linear_rgb)) {
    hypotheses_ = {float(setup.hypotheses.min), float(setup.hypotheses.step()),
                   setup.hypotheses.count, int(round_up(setup.hypotheses.count, kWidestLanes))};
    table_buffer_ = Buffer(device_, std::span<const float>(table_));
  }

  std::string name() const override { return "opencl"; }
  std::string description() const override {
    return device_.info().name + " (" + device_.info().platform + ")";
  }

  void set_active_views(const std::vector<int>& views) override { active_views_ = views; }

  void begin_level(const LevelShape& shape) override {
    level_ = shape.level;
    band_.width = shape.width;
    band_.height = shape.height;
    band_.stride = StripMap<float>::pitch_for(shape.width);
    loaded_views_.clear();
    places_.clear();
  }

  void load_band(RowRange rows, const std::vector<int>& views, const void* encoded,
                 BandEncoding encoding, const std::uint8_t* mask) override {
    restore_reference();
    see_views(views);
    band_.row_begin = rows.begin;
    band_.row_end = rows.end;
    const int bits = encoding == BandEncoding::kBits8    ? 8
                     : encoding == BandEncoding::kBits16 ? 16
                                                         : 32;
    const std::size_t values = std::size_t(rows.size()) * band_.num_views * 3 * band_.width;
    const std::size_t bytes = values * (bits / 8);
    Buffer& source = encoded_.at_least(device_, bytes);
    source.write(std::span(static_cast<const std::byte*>(encoded), bytes));
    Buffer& band = band_memory_.at_least(device_, std::size_t(rows.size()) * band_.num_views *
                                                      channels() * band_.stride * sizeof(float));

    const std::string options = define("SOURCE_BITS", bits);
    const WorkSize all(band_.num_views, rows.size());
    plain_kernel("unpack_channels", "unpack_colours", options)
        .set_args(source, table_buffer_, band_, band)
        .run(all, WorkSize(1, 1));
    if (setup_.options.score.gradient)
      plain_kernel("unpack_channels", "unpack_gradients", options)
          .set_args(band_, band)
          .run(all, WorkSize(1, 1));
    is_masked_ = mask != nullptr;
    if (mask) {
      const std::size_t pixels = std::size_t(rows.size()) * band_.num_views * band_.width;
      Buffer& device_mask = mask_.at_least(device_, pixels);
      device_mask.write(std::span(mask, pixels));
      plain_kernel("unpack_channels", "mask_pixels", options)
          .set_args(device_mask, kMaskedColour, band_, band)
          .run(all, WorkSize(1, 1));
    }
    if (!all_views_.rays_shift_alike) {
      const std::size_t tap_bytes = (channels() > 3 ? 8 : 4) * sizeof(float);
      Buffer& taps = taps_.at_least(
          device_, std::size_t(rows.size()) * band_.num_views * (band_.width + 1) * tap_bytes);
      plain_kernel("unpack_channels", "interleave_taps", options)
          .set_args(band, band_, taps)
          .run(all, WorkSize(1, 1));
    }
  }

  void edge_confidence(int ref, RowRange rows, StripMap<float>& confidence) override {
    const EdgeOptions& edge = setup_.options.edge;
    LaneKernel& kernel = lane_kernel(
        "edge_confidence", define("RADIUS", edge.radius) + define("SQUARED", edge.squared) +
                               define("BOTH_AXES", setup_.kind != LightFieldKind::k3D));
    Buffer& out = map_out(0, rows, sizeof(float));
    kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), out);
    kernel.run(band_.width, rows.size());
    download(out, rows, confidence);
  }

  void density_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                     const StripMap<HypothesisBounds>& bounds) override {
    const ScoreOptions& score = setup_.options.score;
    const std::string options = score_defines() + (score.stop_early ? "" : " -DMOVE_BOUND=0.0f");
    LaneKernel& kernel = lane_kernel("density_score", options);
    Buffer& scores = raw_volume(rows);
    const float floor_views = score.floor_views * float(band_.num_views);
    const int min_views = least_views(band_.num_views);
    const LocalMemory staged = kernel.vectors(kernel.staged ? kStagedVectors * band_.num_views : 1);
    Buffer& tested = upload(2, rows, bounds);

    StripMap<std::uint8_t> in_blocks = todo;
    std::vector<int> packed;
    if (kernel.staged && kernel.lanes > 1 && !score.cubic && all_views_.rays_shift_alike)
      packed = pack_sparse_blocks(rows, kernel.lanes, in_blocks);
    kernel.kernel.set_args(band_memory_.buffer, samples(), band_, strip(ref, rows), ways(ref),
                           hypotheses_, upload(1, rows, in_blocks), tested, score.bandwidth,
                           min_views, floor_views, scores, staged);
    kernel.run(band_.width, rows.size());
    if (!packed.empty()) {
      LaneKernel& sparse = lane_kernel("density_score", options, "density_score_packed");
      const int blocks = int(packed.size()) / (2 * sparse.lanes);
      Buffer& list = packed_.at_least(device_, packed.size() * sizeof(int));
      list.write(std::span<const int>(packed));
      sparse.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), ways(ref), hypotheses_,
                             list, blocks, tested, score.bandwidth, min_views, floor_views, scores,
                             staged);
      sparse.run(blocks * sparse.lanes, 1);
    }
    device_.finish();  // so that the stage's seconds are its own
  }

  void robust_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                    const StripMap<HypothesisBounds>& bounds, ScoreViews views) override {
    const ScoreOptions score =
        own_rows_.size() > 0 ? against_means(setup_.options.score) : setup_.options.score;
    const bool halves = views == ScoreViews::kHalfPlanes;
    LaneKernel& kernel =
        lane_kernel("robust_score",
                    define("CUBIC", score.cubic) + define("HALF_PLANES", halves) + masked_define());
    const ViewSet& members = view_set(ref, views);
    Buffer& scores = raw_volume(rows);
    const float floor_views = (halves ? kLeastHalfPlane : score.floor_views) * float(members.used);
    const OwnPixels own = reference_pixels(ref);
    kernel.kernel.set_args(samples(), band_, strip(ref, rows), own.buffer, own.band, own.view,
                           ways(ref), hypotheses_, upload(1, rows, todo), upload(2, rows, bounds),
                           members.buffer, score.bandwidth, score.gradient_bandwidth,
                           score.gradient_share, least_views(members.used), floor_views, scores);
    kernel.run(band_.width, rows.size());
    device_.finish();
  }

  void ray_mean(int ref, RowRange rows, const StripMap<float>& disparity,
                StripMap<float>& means) override {
    LaneKernel& kernel = lane_kernel("ray_mean", define("CUBIC", setup_.options.score.cubic));
    const std::size_t values = std::size_t(rows.size()) * channels() * band_.stride;
    Buffer& out = means_.at_least(device_, values * sizeof(float));
    kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), rays(ref),
                           upload(3, rows, disparity), setup_.options.score.bandwidth, out);
    kernel.run_pixels(band_.width, rows.size());
    out.read(std::span(means.padded_row(rows.begin * channels()), values));
  }

  void replace_reference(RowRange rows, const StripMap<float>& means) override {
    const std::size_t values = std::size_t(rows.size()) * channels() * band_.stride;
    own_pixels_.at_least(device_, values * sizeof(float))
        .write(std::span(means.padded_row(rows.begin * channels()), values));
    own_rows_ = rows;
    if (setup_.options.score.gradient) {
      const OwnPixels own = reference_pixels(0);
      plain_kernel("unpack_channels", "unpack_gradients", define("SOURCE_BITS", 32))
          .set_args(own.band, own.buffer)
          .run(WorkSize(1, rows.size()), WorkSize(1, 1));
    }
  }
  void restore_reference() override { own_rows_ = {}; }
  int channels() const override { return setup_.options.score.gradient ? 5 : 3; }

  void score_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                     const StripMap<HypothesisBounds>& bounds) override {
    const OwnPixels own = reference_pixels(ref);
    const SupportOptions& support = setup_.options.support;
    LaneKernel& kernel = lane_kernel("score_support", define("RADIUS", support.radius));
    Buffer& supported = supported_scores_.at_least(device_, volume_bytes(rows));
    kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), hypotheses_,
                           upload(1, rows, todo), upload(2, rows, bounds), raw_scores_.buffer,
                           raw_rows_.begin, support.sigma_colour, support.sigma_space, supported);
    kernel.run_pixels(band_.width, rows.size());
    device_.finish();
    winner_reads(supported_scores_, rows);
  }

  void slanted_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                       const StripMap<HypothesisBounds>& bounds,
                       const StripMap<Slope>& slopes) override {
    const OwnPixels own = reference_pixels(ref);
    const SupportOptions& support = setup_.options.support;
    LaneKernel& kernel =
        lane_kernel("score_support", define("RADIUS", support.radius), "slanted_support");
    Buffer& supported = supported_scores_.at_least(device_, volume_bytes(rows));
    kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), hypotheses_,
                           upload(1, rows, todo), upload(2, rows, bounds), upload(5, rows, slopes),
                           raw_scores_.buffer, raw_rows_.begin, support.sigma_colour,
                           support.sigma_space, supported);
    kernel.run_pixels(band_.width, rows.size());
    device_.finish();
    winner_reads(supported_scores_, rows);
  }

  void scanline(int ref, RowRange rows, const StripMap<std::uint8_t>& todo) override {
    const OwnPixels own = reference_pixels(ref);
    GIGARAY_CHECK(rows.begin % kScanlineBlock == 0 && winner_scores_ == &supported_scores_);
    const SupportOptions& support = setup_.options.support;
    LaneKernel& kernel = lane_kernel("scanline", "");
    Buffer& paths = path_scores_.at_least(device_, volume_bytes(score_rows_));
    Buffer& tested = upload(1, score_rows_, todo);
    const std::size_t states = 2 * (hypotheses_.pitch + 2 * kScanlineMargin) + kernel.group;
    const int blocks = (rows.size() + kScanlineBlock - 1) / kScanlineBlock;
    const int directions[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int i = 0; i < 4; ++i) {
      const auto [du, dv] = directions[i];
      kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), hypotheses_, tested,
                             supported_scores_.buffer, score_rows_.begin, du, dv,
                             support.small_price, support.jump_price, support.jump_sigma_colour,
                             int(i > 0), paths, LocalMemory{states * sizeof(float)});
      const std::size_t group = kernel.group;
      if (dv == 0)
        kernel.kernel.run(WorkSize(rows.size() * group, 1), WorkSize(group, 1));
      else
        kernel.kernel.run(WorkSize(band_.width * group, blocks), WorkSize(group, 1));
    }
    device_.finish();
    chosen_by_ = &path_scores_;
  }

  void slope_fit(int ref, RowRange rows, const StripMap<float>& in,
                 StripMap<Slope>& slopes) override {
    const OwnPixels own = reference_pixels(ref);
    LaneKernel& kernel = lane_kernel("slope_fit", "");
    const RowRange around = grown(rows, kSlopeReach, band_.height);
    Buffer& out = map_out(5, rows, sizeof(Slope));
    kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), upload(4, around, in),
                           around.begin, hypotheses_.step,
                           hypotheses_.step * setup_.options.support.max_slope, out);
    kernel.run(band_.width, rows.size());
    download(out, rows, slopes);
  }

  void winner(RowRange rows, const StripMap<std::uint8_t>& todo,
              const StripMap<HypothesisBounds>& bounds, StripMap<float>& disparity,
              StripMap<float>& contrast) override {
    GIGARAY_CHECK(rows.begin >= score_rows_.begin && rows.end <= score_rows_.end);
    LaneKernel& kernel = lane_kernel("winner", define("REFINE", setup_.options.winner.refine));
    Buffer& best = map_out(3, rows, sizeof(float));
    Buffer& lead = map_out(4, rows, sizeof(float));
    const int search = chosen_by_ == winner_scores_ ? 0 : kScanlineSearch;
    kernel.kernel.set_args(own_strip(0, rows), hypotheses_, upload(1, rows, todo),
                           upload(2, rows, bounds), chosen_by_->buffer, winner_scores_->buffer,
                           score_rows_.begin, search, best, lead);
    kernel.run_pixels(band_.width, rows.size());
    download(best, rows, disparity);
    download(lead, rows, contrast);
  }

  void score_of_estimate(RowRange rows, const StripMap<std::uint8_t>& todo,
                         const StripMap<float>& disparity, StripMap<float>& scores) override {
    GIGARAY_CHECK(rows.begin >= score_rows_.begin && rows.end <= score_rows_.end);
    LaneKernel& kernel = lane_kernel("winner", "", "score_of_estimate");
    Buffer& out = map_out(4, rows, sizeof(float));
    kernel.kernel.set_args(own_strip(0, rows), hypotheses_, upload(1, rows, todo),
                           winner_scores_->buffer, score_rows_.begin, upload(3, rows, disparity),
                           out);
    kernel.run_pixels(band_.width, rows.size());
    download(out, rows, scores);
  }

  std::vector<float> scores_at(int u, int v) override {
    GIGARAY_CHECK(score_rows_.contains(v));
    std::vector<float> scores(setup_.hypotheses.count);
    const std::size_t pixel = std::size_t(v - score_rows_.begin) * band_.width + u;
    winner_scores_->buffer.read(std::span(scores),
                                (GIGARAY_PAD + pixel * hypotheses_.pitch) * sizeof(float));
    return scores;
  }

  void bilateral_median(int ref, RowRange rows, int radius, float tolerance,
                        const StripMap<float>& in, StripMap<float>& out) override {
    const OwnPixels own = reference_pixels(ref);
    const bool bilateral = std::isfinite(tolerance);
    LaneKernel& kernel =
        lane_kernel("bilateral_median", define("RADIUS", radius) + define("BILATERAL", bilateral));
    const RowRange around = grown(rows, radius, band_.height);
    // A plain median looks at no colour, but a kernel argument must be some buffer.
    Buffer& band = bilateral ? own.buffer : table_buffer_;
    Buffer& result = map_out(3, rows, sizeof(float));
    const std::size_t window = std::size_t(2 * radius + 1) * (2 * radius + 1);
    kernel.kernel.set_args(band, own.band, own_strip(own.view, rows), upload(4, around, in),
                           around.begin, bilateral ? tolerance : 0.0f, result,
                           kernel.vectors(window));
    kernel.run(band_.width, rows.size());
    download(result, rows, out);
  }

  void mean_radiance(int ref, RowRange rows, const StripMap<float>& disparity,
                     StripMap<Radiance>& radiance) override {
    LaneKernel& kernel = lane_kernel("mean_radiance", score_defines());
    Buffer& out = map_out(5, rows, sizeof(Radiance));
    kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), rays(ref),
                           upload(3, rows, disparity), setup_.options.score.bandwidth, out,
                           kernel.vectors(kernel.staged ? kStagedVectors * band_.num_views : 1));
    kernel.run(band_.width, rows.size());
    download(out, rows, radiance);
  }

  void propagation(int ref, RowRange rows, const StripMap<float>& disparity,
                   const StripMap<float>& confidence, const StripMap<Radiance>& radiance,
                   RowRange state_rows, const float* bars, PackedEstimate* estimates) override {
    const bool atomic = device_.info().has_int64_atomics;
    Kernel& kernel = plain_kernel("propagation", "propagation",
                                  define("ATOMIC", atomic) + define("GUARDED", bars != nullptr));
    const int active_count = int(active_views_.size());
    const std::span<std::byte> host(
        reinterpret_cast<std::byte*>(estimates),
        std::size_t(state_rows.size()) * active_count * band_.width * sizeof(PackedEstimate));
    Buffer state = device_.info().shares_host_memory
                       ? Buffer::over_host_memory(device_, host)
                       : Buffer(device_, std::span<const std::byte>(host));
    Buffer* guard = &state;  // not looked at
    if (bars) {
      const std::span<const float> values(bars, host.size() / sizeof(PackedEstimate));
      guard = &bars_.at_least(device_, values.size_bytes());
      guard->write(values);
    }
    kernel
        .set_args(band_memory_.buffer, band_, strip(ref, rows), rays(ref), active_buffer_,
                  active_count, upload(3, rows, disparity), upload(4, rows, confidence),
                  upload(5, rows, radiance), setup_.options.propagation.tolerance, state_rows.begin,
                  state_rows.end, *guard, state)
        .run(atomic ? WorkSize(band_.width, rows.size()) : WorkSize(active_count, 1),
             WorkSize(1, 1));
    if (device_.info().shares_host_memory)
      opencl::Mapping(state, opencl::Mapping::Access::kRead);
    else
      state.read(host);
  }

  void downsample(RowRange small_rows, float* small) override {
    const int small_width = (band_.width + 1) / 2;
    const std::size_t values = std::size_t(small_rows.size()) * band_.num_views * 3 * small_width;
    Buffer& out = encoded_.at_least(device_, values * sizeof(float));
    LaneKernel& kernel = lane_kernel("downsample", "");
    kernel.kernel.set_args(band_memory_.buffer, band_, small_width, small_rows.begin, out);
    kernel.run(small_width, small_rows.size(), band_.num_views);
    out.read(std::span(small, values));
  }

 private:
  /// Where the pixels of the reference view are, for kernels that look at nothing else.
  struct OwnPixels {
    Buffer& buffer;
    BandParams band;
    int view;
  };
  OwnPixels reference_pixels(int ref) {
    if (own_rows_.size() == 0) return {band_memory_.buffer, band_, place_of(places_, ref)};
    BandParams own = band_;
    own.num_views = 1;
    own.row_begin = own_rows_.begin;
    own.row_end = own_rows_.end;
    return {own_pixels_.buffer, own, 0};
  }

  /// Members of a ScoreViews, for one reference view.
  struct ViewSet {
    Buffer buffer;
    int used = 0;
    int ref = -1;
  };
  const ViewSet& view_set(int ref, ScoreViews views) {
    ViewSet& set = view_sets_[views];
    if (set.ref == ref) return set;
    const std::vector<std::uint8_t> members =
        band_views_.score_members(place_of(places_, ref), views);
    set.buffer = Buffer(device_, std::span<const std::uint8_t>(members));
    set.used = int(members.size() - std::count(members.begin(), members.end(), 0));
    set.ref = ref;
    return set;
  }

  /// `view`: a view of the light field. OwnPixels::view goes into own_strip() instead.
  StripParams strip(int view, RowRange rows) const {
    return own_strip(place_of(places_, view), rows);
  }
  StripParams own_strip(int place, RowRange rows) const {
    return {place, band_.width, rows.begin, rows.end, band_.stride};
  }

  std::size_t volume_bytes(RowRange rows) const {
    return (std::size_t(rows.size()) * band_.width * hypotheses_.pitch + 2 * GIGARAY_PAD) *
           sizeof(float);
  }
  Buffer& raw_volume(RowRange rows) {
    raw_rows_ = rows;
    winner_reads(raw_scores_, rows);
    return raw_scores_.at_least(device_, volume_bytes(rows));
  }
  void winner_reads(Scratch& scores, RowRange rows) {
    chosen_by_ = winner_scores_ = &scores;
    score_rows_ = rows;
  }
  int least_views(int used) const {
    return std::max(1, int(std::ceil(setup_.options.score.min_views * float(used))));
  }

  /// Samples from taps know masked pixels anyway.
  std::string masked_define() const {
    return is_masked_ && all_views_.rays_shift_alike ? define("MASKED", 1) : "";
  }

  std::string score_defines() const {
    const ScoreOptions& score = setup_.options.score;
    return define("ITERATIONS", score.mean_shift_iterations) + define("GRADIENT", score.gradient) +
           define("CUBIC", score.cubic) + masked_define();
  }

  /// From now on the band holds these views.
  void see_views(const std::vector<int>& views) {
    if (views == loaded_views_) return;
    loaded_views_ = views;
    places_ = places_in(views, all_views_.num_views);
    band_.num_views = int(views.size());
    band_views_ = all_views_.of_band(views, level_);
    std::vector<int> active;
    for (const int view : active_views_) active.push_back(places_[view]);
    if (!active.empty()) active_buffer_ = Buffer(device_, std::span<const int>(active));
    rays_ref_ = shifts_ref_ = -1;
    for (auto& [which, set] : view_sets_) set.ref = -1;
  }

  /// The twin's table for rays of `ref`.
  Buffer& rays(int ref) {
    if (rays_ref_ == ref) return rays_buffer_;
    const std::vector<float> table = band_views_.ray_table(place_of(places_, ref));
    rays_buffer_ = Buffer(device_, std::span<const float>(table));
    rays_ref_ = ref;
    return rays_buffer_;
  }
  /// How kernels find samples: shifts from `ref` to all views under all hypotheses, or the table.
  Buffer& ways(int ref) {
    if (!all_views_.rays_shift_alike) return rays(ref);
    Buffer& shifts = shifts_.at_least(
        device_, std::size_t(hypotheses_.count) * band_.num_views * sizeof(BlockShift));
    if (shifts_ref_ != ref)
      plain_kernel("block_shifts", "block_shifts", "")
          .set_args(rays(ref), band_.num_views, hypotheses_, shifts)
          .run(WorkSize(band_.num_views, hypotheses_.count), WorkSize(1, 1));
    shifts_ref_ = ref;
    return shifts;
  }
  /// Where kernels find samples.
  Buffer& samples() { return all_views_.rays_shift_alike ? band_memory_.buffer : taps_.buffer; }

  /// Device copy of some rows of a map. slot: maps of one call need different ones.
  template <class T>
  Buffer& upload(int slot, RowRange rows, const StripMap<T>& map) {
    Buffer& buffer = map_out(slot, rows, sizeof(T));
    buffer.write(std::span(map.padded_row(rows.begin), std::size_t(rows.size()) * map.pitch()));
    return buffer;
  }
  Buffer& map_out(int slot, RowRange rows, std::size_t value_bytes) {
    return maps_[slot].at_least(device_, std::size_t(rows.size()) * band_.stride * value_bytes);
  }
  template <class T>
  void download(const Buffer& buffer, RowRange rows, StripMap<T>& map) {
    buffer.read(std::span(map.padded_row(rows.begin), std::size_t(rows.size()) * map.pitch()));
  }

  Kernel& plain_kernel(const std::string& file, const std::string& entry,
                       const std::string& options) {
    return kernels_.plain(file, entry, options);
  }
  LaneKernel& lane_kernel(const std::string& file, const std::string& options,
                          const std::string& entry = "") {
    return kernels_.lanes(file, options, entry);
  }

  SamplerTwin all_views_;
  SamplerTwin band_views_;  ///< of the level and the loaded views
  BackendSetup setup_;
  opencl::Device device_;
  opencl::KernelSet kernels_;
  std::vector<float> table_;
  HypothesisParams hypotheses_{};
  BandParams band_{};
  int level_ = 0;
  std::vector<int> active_views_, loaded_views_;
  std::vector<int> places_;              ///< of all views among loaded_views_
  bool is_masked_ = false;               ///< some pixels of the band may be
  int rays_ref_ = -1, shifts_ref_ = -1;  ///< The views that rays_buffer_ and shifts_ are for.
  RowRange score_rows_;
  RowRange raw_rows_;                 ///< of raw_scores_
  Scratch* winner_scores_ = nullptr;  ///< the scores of score_rows_
  Scratch* chosen_by_ = nullptr;      ///< path_scores_ after a scan-line step, else the scores

  Buffer table_buffer_, active_buffer_, rays_buffer_;
  std::map<ScoreViews, ViewSet> view_sets_;
  RowRange own_rows_;  ///< of own_pixels_, which stand for the reference view; empty: they don't
  Scratch bars_, shifts_, packed_, encoded_, mask_, band_memory_, taps_, own_pixels_, means_,
      raw_scores_, supported_scores_, path_scores_, maps_[6];
};

}  // namespace

namespace opencl {

template <RaySampler S>
std::unique_ptr<Backend> make_tuned_backend(const S& sampler, const BackendSetup& setup,
                                            const std::string& device_selection,
                                            const TuningOverrides& overrides) {
  return std::make_unique<OpenClBackend>(twin_of(sampler, setup.hypotheses), setup,
                                         device_selection, overrides);
}

template std::unique_ptr<Backend> make_tuned_backend(const EpiSampler&, const BackendSetup&,
                                                     const std::string&, const TuningOverrides&);
template std::unique_ptr<Backend> make_tuned_backend(const GridSampler&, const BackendSetup&,
                                                     const std::string&, const TuningOverrides&);
template std::unique_ptr<Backend> make_tuned_backend(const UnstructuredSampler&,
                                                     const BackendSetup&, const std::string&,
                                                     const TuningOverrides&);

}  // namespace opencl

template <RaySampler S>
std::unique_ptr<Backend> make_opencl_backend(const S& sampler, const BackendSetup& setup,
                                             const std::string& device_selection) {
  return opencl::make_tuned_backend(sampler, setup, device_selection, {});
}

template std::unique_ptr<Backend> make_opencl_backend(const EpiSampler&, const BackendSetup&,
                                                      const std::string&);
template std::unique_ptr<Backend> make_opencl_backend(const GridSampler&, const BackendSetup&,
                                                      const std::string&);
template std::unique_ptr<Backend> make_opencl_backend(const UnstructuredSampler&,
                                                      const BackendSetup&, const std::string&);

}  // namespace gigaray
