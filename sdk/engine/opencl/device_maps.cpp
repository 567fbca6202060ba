// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Maps of the reference view.
#include <cmath>

#include "opencl/device_workspace.h"

namespace gigaray::opencl {

template <class... Args>
void DeviceWorkspace::run_with_reals(const std::string& entry, RowRange rows, const Args&... args) {
  const HypothesisRange& range = setup_.hypotheses;
  if (device_.info().has_fp64) {
    struct Reals {
      double min, step;
      int count;
    };
    run_pixels(entry, rows, Reals{range.min, range.step(), range.count}, args...);
  } else {
    struct Reals {
      float min, step;
      int count;
    };
    run_pixels(entry, rows, Reals{float(range.min), float(range.step()), range.count}, args...);
  }
}

void DeviceWorkspace::edge_confidence(int ref, RowRange rows, const Map<float>& confidence) {
  LaneKernel& kernel = lane_kernel("edge_confidence", edge_defines());
  kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), buffer_of(confidence));
  kernel.run(band_.width, rows.size());
}

void DeviceWorkspace::edge_mask(RowRange rows, const Map<float>& confidence, float threshold,
                                const Map<std::uint8_t>& mask) {
  run_pixels("edge_mask", rows, buffer_of(confidence), threshold, buffer_of(mask));
}

void DeviceWorkspace::erode(RowRange rows, const Map<std::uint8_t>& in,
                            const Map<std::uint8_t>& out) {
  run_pixels("erode", rows, band_.height, buffer_of(in), in.rows().begin, buffer_of(out),
             out.rows().begin);
}

void DeviceWorkspace::dilate(RowRange rows, const Map<std::uint8_t>& in,
                             const Map<std::uint8_t>& out) {
  run_pixels("dilate", rows, band_.height, buffer_of(in), in.rows().begin, buffer_of(out),
             out.rows().begin);
}

void DeviceWorkspace::put_mask(RowRange rows, const Map<std::uint8_t>& mask, const ViewRows& to) {
  run_pixels("put_mask", rows, buffer_of(mask), mask.rows().begin, buffer_of(to), to.rows.begin,
             to.at, to.rows.stored_views);
}

void DeviceWorkspace::select_todo(RowRange rows, const Map<float>& disparity, const ViewRows& mask,
                                  const ShownRows& shown, int shown_at, const ViewRows& search,
                                  const Map<std::uint8_t>& todo,
                                  const Map<HypothesisBounds>& bounds) {
  run_with_reals("select_todo", rows, buffer_of(disparity), int(bool(mask)), buffer_of(mask),
                 mask.rows.begin, mask.at, mask.rows.stored_views, int(bool(shown.rows)),
                 buffer_of(shown.rows), shown.rows.begin, shown.width, shown.shift,
                 shown.rows.stored_views, shown_at, int(bool(search)), buffer_of(search),
                 search.rows.begin, search.at, search.rows.stored_views, buffer_of(todo),
                 buffer_of(bounds));
}

void DeviceWorkspace::bound_thin_holes(RowRange rows, const Map<std::uint8_t>& todo,
                                       const Map<std::uint8_t>& wide, const Map<float>& estimates,
                                       const Map<HypothesisBounds>& bounds) {
  run_with_reals("bound_thin_holes", rows, band_.height, buffer_of(todo), buffer_of(wide),
                 buffer_of(estimates), buffer_of(bounds));
}

void DeviceWorkspace::grow_todo(RowRange rows, int radius, const Map<std::uint8_t>& todo,
                                const Map<HypothesisBounds>& bounds,
                                const Map<std::uint8_t>& grown_todo,
                                const Map<HypothesisBounds>& grown_bounds) {
  const std::size_t pixels = std::size_t(band_.height) * band_.stride;
  Buffer& along_u = grown_.at_least(device_, pixels);
  Buffer& bounds_u = grown_bounds_.at_least(device_, pixels * sizeof(HypothesisBounds));
  run_pixels("grow_along_u", grown(rows, radius, band_.height), radius, buffer_of(todo),
             buffer_of(bounds), along_u, bounds_u);
  run_pixels("grow_along_v", rows, radius, band_.height, along_u, bounds_u, buffer_of(grown_todo),
             buffer_of(grown_bounds));
}

void DeviceWorkspace::beside_jumps(RowRange rows, const Map<float>& map, float jump, int reach,
                                   const Map<std::uint8_t>& todo, const Map<std::uint8_t>& beside) {
  const std::size_t pixels = std::size_t(band_.height) * band_.stride;
  Buffer& jumps = jumps_.at_least(device_, pixels);
  Buffer& near = near_.at_least(device_, pixels);
  const RowRange around = grown(rows, reach, band_.height);
  run_pixels("find_jumps", around, band_.height, buffer_of(map), jump, jumps);
  run_pixels("jumps_along_u", around, reach, jumps, near);
  run_pixels("beside_jumps", rows, band_.height, reach, near, buffer_of(todo), buffer_of(beside));
}

std::vector<int> DeviceWorkspace::count_rows(const Map<std::uint8_t>& mask) {
  return count("count_rows", buffer_of(mask));
}

std::vector<int> DeviceWorkspace::count_estimates(const Map<float>& estimates) {
  return count("count_estimates", buffer_of(estimates));
}

std::vector<int> DeviceWorkspace::count(const std::string& entry, const Buffer& map) {
  std::vector<int> counts(band_.height);
  Buffer& buffer = counts_.at_least(device_, (counts.size() + 1) * sizeof(int));
  run_rows(entry, {0, band_.height}, map, buffer);
  buffer.read(std::span(counts));
  traffic_.bytes_down += counts.size() * sizeof(int);
  ++traffic_.waits;
  device_.log()->collect();
  return counts;
}

void DeviceWorkspace::take_winners(RowRange rows, bool is_last_level, const Map<std::uint8_t>& todo,
                                   const Map<HypothesisBounds>& bounds, const Map<float>& winners,
                                   const Map<float>& contrast, const Map<float>& best,
                                   const Map<float>& edges, const Map<float>& disparity,
                                   const Map<float>& confidence) {
  run_with_reals("take_winners", rows, int(is_last_level),
                 best ? setup_.options.winner.min_relief : -1.0f, int(bool(edges)), buffer_of(todo),
                 buffer_of(bounds), buffer_of(winners), buffer_of(contrast), buffer_of(best),
                 buffer_of(edges), buffer_of(disparity), buffer_of(confidence));
}

void DeviceWorkspace::step_back(RowRange rows, float farther, const Map<float>& winners,
                                const Map<float>& contrast, const Map<float>& best,
                                const Map<float>& own, const Map<float>& disparity,
                                const Map<float>& confidence) {
  run_pixels("step_back", rows, farther, kStepBackLead, buffer_of(winners), buffer_of(contrast),
             buffer_of(best), buffer_of(own), buffer_of(disparity), buffer_of(confidence));
}

void DeviceWorkspace::side_evidence(int ref, RowRange rows, float jump,
                                    const Map<std::uint8_t>& todo, const Map<float>& disparity,
                                    const Map<float>& evidence) {
  const OwnPixels own = reference_pixels(ref);
  LaneKernel& kernel = lane_kernel("jump_sides", sides_defines(), "side_evidence");
  kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), own.buffer, own.band,
                         own.view, rays(ref), buffer_of(todo), buffer_of(disparity), jump,
                         float(setup_.hypotheses.min), float(setup_.hypotheses.max),
                         SIDE_WIDER * setup_.options.score.bandwidth, buffer_of(evidence));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::choose_sides(int ref, RowRange rows, float jump, const Map<float>& disparity,
                                   const Map<float>& confidence, const Map<float>& evidence,
                                   const Map<float>& chosen, const Map<float>& chosen_confidence) {
  const OwnPixels own = reference_pixels(ref);
  LaneKernel& kernel = lane_kernel("jump_sides", sides_defines(), "choose_sides");
  kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), buffer_of(disparity),
                         buffer_of(confidence), buffer_of(evidence), jump,
                         setup_.options.support.sigma_colour, buffer_of(chosen),
                         buffer_of(chosen_confidence));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::find_hidden(int ref, RowRange rows, float apart,
                                  const Map<std::uint8_t>& todo, const Map<float>& disparity,
                                  const Map<float>& confidence, const Map<std::uint8_t>& hidden) {
  LaneKernel& kernel = lane_kernel("hidden", "", "find_hidden");
  kernel.kernel.set_args(band_, strip(ref, rows), rays(ref), buffer_of(todo), buffer_of(disparity),
                         buffer_of(confidence), float(setup_.hypotheses.min),
                         hidden_steps(setup_.hypotheses, apart), apart, buffer_of(hidden));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::find_specks(RowRange rows, float apart, const Map<std::uint8_t>& todo,
                                  const Map<float>& disparity, const Map<std::uint8_t>& hidden,
                                  const Map<std::uint8_t>& guessed) {
  LaneKernel& kernel = lane_kernel("hidden", "", "find_specks");
  kernel.kernel.set_args(strip(rows), band_.height, buffer_of(todo), buffer_of(disparity),
                         buffer_of(hidden), apart, buffer_of(guessed));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::fill_hidden(RowRange rows, float apart, const Map<std::uint8_t>& guessed,
                                  const Map<float>& disparity, const Map<float>& confidence) {
  LaneKernel& kernel = lane_kernel("hidden", "", "fill_hidden");
  kernel.kernel.set_args(strip(rows), buffer_of(guessed), apart, buffer_of(disparity),
                         buffer_of(confidence));
  kernel.run_pixels(band_.width, rows.size());
}

void DeviceWorkspace::bilateral_median(int ref, RowRange rows, int radius, float tolerance,
                                       const Map<float>& in, const Map<float>& out) {
  const bool bilateral = std::isfinite(tolerance);
  const std::size_t window = std::size_t(2 * radius + 1) * (2 * radius + 1);
  LaneKernel& kernel =
      lane_kernel("bilateral_median", median_defines(radius, bilateral), "", window);
  // A plain median looks at no colour, but a kernel argument must be some buffer.
  const OwnPixels own = bilateral ? reference_pixels(ref) : OwnPixels{table_buffer_, band_, 0};
  kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), buffer_of(in),
                         bilateral ? tolerance : 0.0f, buffer_of(out), kernel.vectors(window));
  kernel.run(band_.width, rows.size());
}

void DeviceWorkspace::slope_fit(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                                const Map<float>& in, const Map<Slope>& slopes) {
  const OwnPixels own = reference_pixels(ref);
  LaneKernel& kernel = lane_kernel("slope_fit", "");
  kernel.kernel.set_args(own.buffer, own.band, own_strip(own.view, rows), buffer_of(todo),
                         buffer_of(in), hypotheses_.step,
                         hypotheses_.step * setup_.options.support.max_slope, buffer_of(slopes));
  kernel.run(band_.width, rows.size());
}

void DeviceWorkspace::accept(RowRange rows, float threshold, const Map<std::uint8_t>& todo,
                             const Map<float>& confidence, const Map<float>& estimates) {
  run_pixels("accept", rows, threshold, buffer_of(todo), buffer_of(confidence),
             buffer_of(estimates));
}

void DeviceWorkspace::mean_radiance(int ref, RowRange rows, const Map<float>& disparity,
                                    const Map<Radiance>& radiance) {
  LaneKernel& kernel = lane_kernel("mean_radiance", score_defines());
  kernel.kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), rays(ref),
                         buffer_of(disparity), setup_.options.score.bandwidth, buffer_of(radiance),
                         kernel.vectors(kernel.staged ? kStagedVectors * band_.num_views : 1));
  kernel.run(band_.width, rows.size());
}

void DeviceWorkspace::sum_counts(int rows, Buffer& counts) {
  plain_kernel(kMapSteps, "sum_counts", real_define())
      .set_args(rows, counts)
      .run(WorkSize(1), WorkSize(1));
}

int DeviceWorkspace::compact_tuples(int view, RowRange rows, const Map<float>& disparity,
                                    const Map<float>& confidence, const Map<Radiance>& radiance,
                                    Memory& tuples) {
  static_assert(sizeof(RayTuple) == 36 && sizeof(Radiance) == 12);
  Buffer& counts = counts_.at_least(device_, (rows.size() + 1) * sizeof(int));
  run_rows("count_estimates", rows, buffer_of(disparity), counts);
  sum_counts(rows.size(), counts);
  run_rows("compact_tuples", rows, view, level_, buffer_of(disparity), buffer_of(confidence),
           buffer_of(radiance), counts, buffer_of(&tuples));
  int count = 0;
  counts.read(std::span(&count, 1), rows.size() * sizeof(int));
  traffic_.bytes_down += sizeof count;
  ++traffic_.waits;
  device_.log()->collect();
  return count;
}

}  // namespace gigaray::opencl
