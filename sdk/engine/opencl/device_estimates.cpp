// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Estimates of all active views.
#include "opencl/device_workspace.h"

namespace gigaray::opencl {

void DeviceWorkspace::unpack_estimates(RowRange rows, const ViewRows& estimates,
                                       const Map<float>& disparity, const Map<float>& confidence) {
  run_pixels("unpack_estimates", rows, buffer_of(estimates), estimates.rows.begin, estimates.at,
             estimates.rows.stored_views, buffer_of(disparity), buffer_of(confidence));
}

void DeviceWorkspace::close_cracks(RowRange rows, int width, float apart,
                                   const Map<float>& disparity, const Map<float>& confidence,
                                   const Map<float>& closed, const Map<float>& closed_confidence,
                                   const ViewRows& estimates) {
  run_pixels("close_cracks", rows, band_.height, width, apart, buffer_of(disparity),
             buffer_of(confidence), buffer_of(closed), buffer_of(closed_confidence),
             buffer_of(estimates), estimates.rows.begin, estimates.at, estimates.rows.stored_views);
}

Kernel& DeviceWorkspace::arrival_kernel(const std::string& entry) {
  return plain_kernel("propagation", entry, arrival_defines());
}

void DeviceWorkspace::run_arrivals(Kernel& kernel, RowRange rows) {
  constexpr std::size_t kGroup = 64;
  if (device_.info().has_int64_atomics)
    kernel.run(WorkSize(round_up(band_.width, kGroup), rows.size()), WorkSize(kGroup, 1));
  else
    kernel.run(WorkSize(active_views_.size()), WorkSize(1));
}

void DeviceWorkspace::set_bars(int ref, RowRange rows, const Map<float>& disparity,
                               RowRange reached, int finished, const RowsOnDevice& estimates,
                               const RowsOnDevice& bars) {
  GIGARAY_CHECK(estimates.begin == bars.begin);
  Kernel& kernel = arrival_kernel("set_bars");
  kernel.set_args(band_, strip(ref, rows), rays(ref), active_buffer_, int(active_views_.size()),
                  buffer_of(disparity), reached.begin, reached.end, bars.begin, finished,
                  setup_.options.propagation.finished_lead, buffer_of(estimates), buffer_of(bars));
  run_arrivals(kernel, rows);
}

void DeviceWorkspace::propagation(int ref, RowRange rows, const Map<float>& disparity,
                                  const Map<float>& confidence, const Map<Radiance>& radiance,
                                  RowRange reached, int finished, const RowsOnDevice& bars,
                                  const RowsOnDevice& estimates) {
  GIGARAY_CHECK(finished == 0 || estimates.begin == bars.begin);
  Kernel& kernel = arrival_kernel("propagation");
  kernel.set_args(band_memory_.buffer, band_, strip(ref, rows), rays(ref), active_buffer_,
                  int(active_views_.size()), buffer_of(disparity), buffer_of(confidence),
                  buffer_of(radiance), setup_.options.propagation.tolerance, reached.begin,
                  reached.end, estimates.begin, finished, buffer_of(bars), buffer_of(estimates));
  run_arrivals(kernel, rows);
}

void DeviceWorkspace::clear_bars(int ref, RowRange rows, const Map<float>& disparity,
                                 RowRange reached, int finished, const RowsOnDevice& bars) {
  Kernel& kernel = arrival_kernel("clear_bars");
  kernel.set_args(band_, strip(ref, rows), rays(ref), active_buffer_, int(active_views_.size()),
                  buffer_of(disparity), reached.begin, reached.end, bars.begin, finished,
                  buffer_of(bars));
  run_arrivals(kernel, rows);
}

void DeviceWorkspace::coarsen_bounds(RowRange rows, const ViewRows& estimates,
                                     const ViewRows& search, const ViewRows& coarse) {
  constexpr std::size_t kGroup = 8;
  const StripParams small{0, (band_.width + 1) / 2, rows.begin, rows.end,
                          map_pitch((band_.width + 1) / 2)};
  Buffer& scratch =
      intervals_.at_least(device_, std::size_t(rows.size()) * band_.width * 2 * sizeof(float));
  plain_kernel(kMapSteps, "coarsen_bounds", real_define())
      .set_args(small, float(setup_.hypotheses.min), float(setup_.hypotheses.max), band_.width,
                band_.height, buffer_of(estimates), estimates.rows.begin, estimates.at,
                estimates.rows.stored_views, int(bool(search)), buffer_of(search),
                search.rows.begin, search.at, search.rows.stored_views, scratch, buffer_of(coarse),
                coarse.rows.begin, coarse.at, coarse.rows.stored_views)
      .run(WorkSize(round_up(rows.size(), kGroup)), WorkSize(kGroup));
}

void DeviceWorkspace::fill_view(RowRange rows, const LevelShape& shape, const ViewRows& estimates,
                                const ViewMaps& coarse, const ShownRows& shown, int shown_at,
                                const ViewMaps& maps) {
  constexpr std::size_t kGroup = 64;
  const StripParams strip{0, shape.width, rows.begin, rows.end, map_pitch(shape.width)};
  const bool has_coarse = bool(coarse.disparity);
  plain_kernel(kMapSteps, "fill_view", real_define())
      .set_args(strip, shape.level, estimates.at, estimates.rows.stored_views, buffer_of(estimates),
                estimates.rows.begin, int(has_coarse),
                has_coarse ? map_pitch(coarse.disparity.width()) : 0, buffer_of(coarse.disparity),
                buffer_of(coarse.confidence), buffer_of(coarse.level), int(bool(shown.rows)),
                buffer_of(shown.rows), shown.rows.begin, shown.width, shown.rows.stored_views,
                shown_at, buffer_of(maps.disparity), buffer_of(maps.confidence),
                buffer_of(maps.level))
      .run(WorkSize(round_up(shape.width, kGroup), rows.size()), WorkSize(kGroup, 1));
}

}  // namespace gigaray::opencl
