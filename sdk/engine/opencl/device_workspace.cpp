// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/device_workspace.h"

#include <algorithm>
#include <cmath>

#include "src/band_views.h"

namespace gigaray::opencl {
namespace {

static_assert(kMapPad == GIGARAY_PAD);
static_assert(kHiddenReach == HIDDEN_REACH && kSpeckReach == SPECK_RADIUS);
static_assert(kSideReach == SIDE_WINDOW + SIDE_VIEW_REACH && kSideColours == SIDE_COLOURS);
static_assert(kScanlineBlock == SCANLINE_BLOCK && kScanlineReach == SCANLINE_REACH);

/// Lanes never reach beyond this many hypotheses of a pixel.
constexpr int kWidestLanes = 16;

}  // namespace

class DeviceWorkspace::DeviceMemory : public Memory {
 public:
  explicit DeviceMemory(Buffer memory) : Memory(memory.bytes()), buffer(std::move(memory)) {}
  Buffer buffer;
};

DeviceWorkspace::DeviceWorkspace(SamplerTwin sampler, const WorkspaceSetup& setup,
                                 const Device& device, TuningOverrides overrides)
    : all_views_(std::move(sampler)),
      setup_(setup),
      device_(device.with_own_queue()),
      kernels_(device_, all_views_.kernel_file,
               define("CHANNELS", channels()) + define("SHIFT_ALIKE", all_views_.rays_shift_alike),
               all_views_.num_views, std::move(overrides)),
      table_(colour_table(setup.bit_depth, setup.options.score.linear_rgb)) {
  hypotheses_ = {float(setup.hypotheses.min), float(setup.hypotheses.step()),
                 setup.hypotheses.count, int(round_up(setup.hypotheses.count, kWidestLanes))};
  table_buffer_ = Buffer(device_, std::span<const float>(table_));
  kernels_.join(usual_files());
}

std::string DeviceWorkspace::description() const {
  return device_.info().name + " (" + device_.info().platform + ")";
}

// ---- Memory -------------------------------------------------------------------------------------

std::shared_ptr<Memory> DeviceWorkspace::allocate(std::size_t bytes) {
  return std::make_shared<DeviceMemory>(Buffer::zeroed(device_, std::max<std::size_t>(bytes, 1)));
}

std::shared_ptr<Memory> DeviceWorkspace::adopt(std::span<std::byte> host) {
  if (device_.info().shares_host_memory)
    return std::make_shared<DeviceMemory>(Buffer::over_host_memory(device_, host, true));
  auto memory = std::make_shared<DeviceMemory>(Buffer(device_, host.size()));
  write(*memory, host, 0);
  return memory;
}

void DeviceWorkspace::write(Memory& memory, std::span<const std::byte> data, std::size_t offset) {
  static_cast<DeviceMemory&>(memory).buffer.write(data, offset);
  traffic_.bytes_up += data.size();
  ++traffic_.waits;
}

void DeviceWorkspace::read(const Memory& memory, std::span<std::byte> data, std::size_t offset) {
  buffer_of(&memory).read(data, offset);
  traffic_.bytes_down += data.size();
  ++traffic_.waits;
  device_.log()->collect();
}

void DeviceWorkspace::read_later(const Memory& memory, std::span<std::byte> data,
                                 std::size_t offset) {
  buffer_of(&memory).read_later(data, offset);
  traffic_.bytes_down += data.size();
}

std::span<std::byte> DeviceWorkspace::map(Memory& memory, bool to_fill) {
  ++traffic_.waits;
  (to_fill ? traffic_.bytes_up : traffic_.bytes_down) += memory.bytes();
  cl_int error = CL_SUCCESS;
  void* const data = device_.queue().enqueueMapBuffer(
      buffer_of(&memory).get(), CL_TRUE, to_fill ? CL_MAP_WRITE_INVALIDATE_REGION : CL_MAP_READ, 0,
      memory.bytes(), nullptr, nullptr, &error);
  check_cl(error, "clEnqueueMapBuffer");
  return {static_cast<std::byte*>(data), memory.bytes()};
}

void DeviceWorkspace::unmap(Memory& memory, std::span<std::byte> mapped) {
  GIGARAY_CL(device_.queue().enqueueUnmapMemObject(buffer_of(&memory).get(), mapped.data()));
}

void DeviceWorkspace::finish() {
  device_.finish();
  ++traffic_.waits;
  device_.log()->collect();
}

void DeviceWorkspace::keep_pace() {
  cl::Event now;
  GIGARAY_CL(device_.queue().enqueueMarkerWithWaitList(nullptr, &now));
  GIGARAY_CL(device_.queue().flush());
  if (pace_()) {
    GIGARAY_CL(pace_.wait());
    ++traffic_.waits;
  }
  pace_ = now;
}

const Buffer& DeviceWorkspace::buffer_of(const Memory* memory) const {
  return memory ? static_cast<const DeviceMemory*>(memory)->buffer : table_buffer_;
}

// ---- Pixels -------------------------------------------------------------------------------------

void DeviceWorkspace::set_active_views(const std::vector<int>& views) { active_views_ = views; }

void DeviceWorkspace::begin_level(const LevelShape& shape, int band_rows) {
  level_ = shape.level;
  band_.width = shape.width;
  band_.height = shape.height;
  band_.stride = map_pitch(shape.width);
  ring_ = {{}, band_rows};
  loaded_views_.clear();
  places_.clear();
  for (RawScores& volume : volumes_) volume.rows = {};
}

void DeviceWorkspace::load_band(RowRange rows, RowRange fresh, const std::vector<int>& views,
                                const EncodedRows& source) {
  restore_reference();
  see_views(views);
  const RowRange want_gradients = ring_.load(rows, fresh);
  band_.row_begin = ring_.rows.begin;
  band_.row_end = ring_.rows.end;
  band_.slots = ring_.slots;
  band_.first_slot = ring_.slot(ring_.rows.begin);
  if (at_ != source.at) {
    at_ = source.at;
    at_buffer_ = upload(at_);
  }
  const int bits = source.encoding == BandEncoding::kBits8    ? 8
                   : source.encoding == BandEncoding::kBits16 ? 16
                                                              : 32;
  const std::size_t lines = std::size_t(ring_.slots) * band_.num_views;
  Buffer& band = band_memory_.at_least(device_, lines * channels() * band_.stride * sizeof(float));
  const WorkSize all(band_.num_views, fresh.size());
  plain_kernel("unpack_channels", "unpack_colours")
      .set_args(buffer_of(source.pixels), bits, source.pixels.begin, source.pixels.stored_views,
                at_buffer_, table_buffer_, band_, fresh.begin, band)
      .run(all, WorkSize(1, 1));
  if (setup_.options.score.gradient)
    plain_kernel("unpack_channels", "unpack_gradients")
        .set_args(band_, want_gradients.begin, band)
        .run(WorkSize(band_.num_views, want_gradients.size()), WorkSize(1, 1));
  const ShownRows& shown = source.shown;
  is_masked_ = bool(shown.rows);
  if (is_masked_)
    plain_kernel("unpack_channels", "mask_pixels")
        .set_args(buffer_of(shown.rows), shown.rows.begin, shown.width, shown.shift,
                  shown.rows.stored_views, at_buffer_, kMaskedColour, band_, fresh.begin, band)
        .run(all, WorkSize(1, 1));
  if (!all_views_.rays_shift_alike) {
    const std::size_t tap_bytes = (channels() > 3 ? 8 : 4) * sizeof(float);
    Buffer& taps = taps_.at_least(device_, lines * (band_.width + 1) * tap_bytes);
    plain_kernel("unpack_channels", "interleave_taps")
        .set_args(band, band_, fresh.begin, taps)
        .run(all, WorkSize(1, 1));
  }
}

void DeviceWorkspace::downsample(RowRange small_rows, const RowsOnDevice& small, int first) {
  const int small_width = (band_.width + 1) / 2;
  LaneKernel& kernel = lane_kernel("downsample", "");
  kernel.kernel.set_args(band_memory_.buffer, band_, small_width, small_rows.begin, small.begin,
                         small.stored_views, first, buffer_of(small));
  kernel.run(small_width, small_rows.size(), band_.num_views);
}

void DeviceWorkspace::ray_mean(int ref, RowRange rows, const Map<std::uint8_t>& wanted,
                               const Map<float>& disparity, const Map<float>& means) {
  LaneKernel& kernel = lane_kernel("ray_mean", define("CUBIC", setup_.options.score.cubic));
  kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), rays(ref), buffer_of(wanted),
                         buffer_of(disparity), setup_.options.score.bandwidth, buffer_of(means));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::mean_gradients(RowRange rows, const Map<float>& means) {
  if (!setup_.options.score.gradient) return;
  const OwnPixels own = pixels_of(means);
  plain_kernel("unpack_channels", "unpack_gradients")
      .set_args(own.band, rows.begin, own.buffer)
      .run(WorkSize(1, rows.size()), WorkSize(1, 1));
}

DeviceWorkspace::OwnPixels DeviceWorkspace::pixels_of(const Map<float>& means) const {
  BandParams own = band_;
  own.num_views = 1;
  own.row_begin = own.first_slot = 0;
  own.row_end = own.slots = band_.height;
  return {buffer_of(means), own, 0};
}

DeviceWorkspace::OwnPixels DeviceWorkspace::reference_pixels(int ref) const {
  if (means_) return pixels_of(means_);
  return {band_memory_.buffer, band_, place_of(places_, ref)};
}

const DeviceWorkspace::ViewSet& DeviceWorkspace::view_set(int ref, ScoreViews views) {
  const auto [found, is_new] = view_sets_.try_emplace({views, ref});
  if (is_new) {
    const std::vector<std::uint8_t> members =
        band_views_.score_members(place_of(places_, ref), views);
    found->second = {upload(members),
                     int(members.size() - std::count(members.begin(), members.end(), 0))};
  }
  return found->second;
}

StripParams DeviceWorkspace::strip(int view, RowRange rows) const {
  return own_strip(place_of(places_, view), rows);
}

void DeviceWorkspace::see_views(const std::vector<int>& views) {
  if (views == loaded_views_) return;
  loaded_views_ = views;
  places_ = places_in(views, all_views_.num_views);
  band_.num_views = int(views.size());
  band_views_ = all_views_.of_band(views, level_);
  std::vector<int> active;
  for (const int view : active_views_) active.push_back(places_[view]);
  if (!active.empty()) active_buffer_ = upload(active);
  shifts_ref_ = -1;
  rays_.clear();
  view_sets_.clear();
  if (int(views.size()) < all_views_.num_views) return;
  // Every view is compared with all others: their tables go up together, and no view waits later.
  for (const int ref : active_views_) {
    rays(ref);
    if (!setup_.options.score.gradient) continue;
    view_set(ref, ScoreViews::kAll);
    if (level_ > 0) continue;
    view_set(ref, ScoreViews::kFirst);
    if (setup_.options.support.half_planes) view_set(ref, ScoreViews::kHalfPlanes);
  }
}

Buffer& DeviceWorkspace::rays(int ref) {
  const auto [found, is_new] = rays_.try_emplace(ref);
  if (is_new) found->second = upload(band_views_.ray_table(place_of(places_, ref)));
  return found->second;
}

Buffer& DeviceWorkspace::ways(int ref) {
  if (!all_views_.rays_shift_alike) return rays(ref);
  Buffer& shifts = shifts_.at_least(
      device_, std::size_t(hypotheses_.count) * band_.num_views * sizeof(BlockShift));
  if (shifts_ref_ != ref)
    plain_kernel("block_shifts", "block_shifts")
        .set_args(rays(ref), band_.num_views, hypotheses_, shifts)
        .run(WorkSize(band_.num_views, hypotheses_.count), WorkSize(1, 1));
  shifts_ref_ = ref;
  return shifts;
}

// ---- Scores: what device_scores.cpp shares with the others
// ----------------------------------------

std::size_t DeviceWorkspace::volume_bytes(RowRange rows) const {
  return (std::size_t(rows.size()) * band_.width * hypotheses_.pitch + 2 * GIGARAY_PAD) *
         sizeof(float);
}

void DeviceWorkspace::winner_reads(Scratch& scores, RowRange rows) {
  chosen_by_ = winner_scores_ = &scores;
  score_rows_ = rows;
}

int DeviceWorkspace::least_views(int used) const {
  return int(std::ceil(setup_.options.score.min_views * float(used)));
}

// ---- What kernels are built with ----------------------------------------------------------------

std::string DeviceWorkspace::score_defines() const {
  const ScoreOptions& score = setup_.options.score;
  return define("ITERATIONS", score.mean_shift_iterations) + define("GRADIENT", score.gradient) +
         define("CUBIC", score.cubic);
}

std::string DeviceWorkspace::density_defines() const {
  return score_defines() + masked_define() +
         (setup_.options.score.stop_early ? "" : " -DMOVE_BOUND=0.0f");
}

std::string DeviceWorkspace::robust_defines(bool half_planes) const {
  const ScoreOptions& score = setup_.options.score;
  return define("CUBIC", score.cubic) + define("HALF_PLANES", half_planes) +
         define("SLACK", score.colour_slack > 0 || score.gradient_slack > 0) + masked_define();
}

std::string DeviceWorkspace::edge_defines() const {
  const EdgeOptions& edge = setup_.options.edge;
  return define("EDGE_RADIUS", edge.radius) + define("SQUARED", edge.squared) +
         define("BOTH_AXES", setup_.kind != LightFieldKind::k3D);
}

std::string DeviceWorkspace::support_defines() const {
  return define("SUPPORT_RADIUS", setup_.options.support.radius);
}

std::string DeviceWorkspace::sides_defines() const {
  return define("CUBIC", setup_.options.score.cubic);
}

std::string DeviceWorkspace::winner_defines() const {
  const WinnerOptions& options = setup_.options.winner;
  return define("REFINE", options.refine) + define("PEAK", options.peak_share > 0);
}

std::string DeviceWorkspace::median_defines(int radius, bool bilateral) {
  return define("MEDIAN_RADIUS", radius) + define("BILATERAL", bilateral);
}

std::string DeviceWorkspace::arrival_defines() const {
  return define("ATOMIC", device_.info().has_int64_atomics);
}

std::vector<KernelFile> DeviceWorkspace::usual_files() const {
  const DepthOptions& options = setup_.options;
  std::vector<KernelFile> files{
      {"unpack_channels", ""},
      {"downsample", ""},
      {"winner", winner_defines()},
      {"bilateral_median", median_defines(options.winner.median_radius, true)},
      {"mean_radiance", score_defines()},
      {"propagation", arrival_defines()}};
  if (options.score.gradient)
    files.push_back({"robust_score", robust_defines(false)});
  else
    files.push_back({"density_score", density_defines()});
  if (all_views_.rays_shift_alike) files.push_back({"block_shifts", ""});
  if (options.support.radius > 0) files.push_back({"score_support", support_defines()});
  if (options.support.slanted) files.push_back({"slope_fit", ""});
  if (options.support.choose_sides) files.push_back({"jump_sides", sides_defines()});
  if (options.support.fill_hidden) files.push_back({"hidden", ""});
  if (options.support.scanline) files.push_back({"scanline", ""});
  if (options.winner.weigh_by_edge) files.push_back({"edge_confidence", edge_defines()});
  return files;
}

}  // namespace gigaray::opencl
