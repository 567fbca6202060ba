// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/reconstruct.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "coarse_guide.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/smoothing.h"
#include "gigaray/engine/device.h"
#include "gigaray/engine/estimator.h"
#include "opencl/cache_folder.h"
#include "opencl/device.h"
#include "opencl/ready_kernels.h"
#include "prepared.h"
#include "reconstruction_impl.h"
#include "run.h"
#include "stage_timer.h"
#include "view_consensus.h"

namespace gigaray {
namespace {

/// What the kernels of a run depend on, without asking a device. devices: as they are stated.
std::string kernel_job(const Prepared& run, const std::string& devices) {
  const DepthOptions& o = run.options;
  std::ostringstream text;
  text << devices << '|' << to_string(run.light_field.kind) << ' '
       << run.light_field.pixels->bit_depth() << ' ' << run.light_field.pixels->has_mask() << ' '
       << o.edge.threshold << ' ' << o.edge.squared << ' ' << o.score.linear_rgb << ' '
       << o.score.cubic << ' ' << o.score.gradient << ' ' << o.score.ray_mean << ' '
       << o.support.radius << ' ' << o.support.slanted << ' ' << o.support.half_planes << ' '
       << o.support.choose_sides << ' ' << o.support.fill_hidden << ' ' << o.support.scanline << ' '
       << o.winner.refine << ' ' << (o.winner.peak_share > 0) << ' '
       << (o.score.colour_slack > 0 || o.score.gradient_slack > 0) << ' ' << o.winner.median_radius
       << ' ' << o.propagation.fine_to_coarse;
  return text.str();
}

/// Of devices that share a run: the least that one of them has.
DeviceLimits limits_of(const std::vector<DeviceInfo>& devices) {
  const DeviceInfo& first = devices.front();
  DeviceLimits limits{double(first.global_memory), double(first.max_allocation),
                      first.shares_host_memory, int(devices.size())};
  for (const DeviceInfo& device : devices) {
    if (device.shares_host_memory != first.shares_host_memory)
      throw Error(ErrorCode::kDevice, "devices " + first.name + " and " + device.name +
                                          " can't share a run: one of them has memory of its own");
    limits.memory = std::min(limits.memory, double(device.global_memory));
    limits.largest_buffer = std::min(limits.largest_buffer, double(device.max_allocation));
  }
  return limits;
}

/// Selections of devices one by one, as a run notes them.
std::string joined(const std::string& selection) {
  if (selection.find_first_not_of(" ,") == std::string::npos) return selection;
  std::string each;
  try {
    for (const std::string& one : opencl::selections_of(selection))
      each += (each.empty() ? "" : ",") + one;
  } catch (const Error&) {  // the run will say so
    return selection;
  }
  return each;
}

/// Of devices that are not open. Where there are none the run will say so, and a forecast is one
/// for a usual one.
DeviceLimits limits_of(const std::string& selection) {
  try {
    return limits_of(select_devices(selection));
  } catch (const Error&) {
    return {};
  }
}

constexpr DeviceLimits kHost{0, std::numeric_limits<double>::infinity(), true, 1};

/// The plan, with the compiler in the forecast where there is something to compile. devices: as
/// they are stated; none: the reference.
MemoryPlan plan_run(const Prepared& run, const std::optional<std::string>& devices,
                    const DeviceLimits& limits) {
  MemoryPlan plan = plan_memory(run.light_field, widest(run.options), run.hypotheses, limits);
  if (!devices || opencl::kernels_are_ready(kernel_job(run, *devices))) {
    plan.forecast.memory_bytes -= plan.compiler_bytes;
    plan.forecast.memory_all_bytes -= plan.compiler_bytes;
  }
  return plan;
}

}  // namespace

Estimator::Estimator(Device device) : devices_{std::move(device)} {}

Estimator::Estimator(std::vector<Device> devices) : devices_(std::move(devices)) {
  if (devices_.empty())
    throw Error(ErrorCode::kInvalidArgument, "an estimator needs a device; there are none");
}

Estimator Estimator::reference() { return Estimator(Reference()); }

Estimator Estimator::of(const BackendChoice& choice) {
  if (choice.backend == "reference") return reference();
  if (choice.backend == "opencl") return Estimator(Device::open_each(choice.device));
  throw Error(ErrorCode::kInvalidArgument,
              "backend " + choice.backend + ": there are opencl and reference");
}

Reconstruction reconstruct(const LightField& light_field, const DepthOptions& options,
                           const BackendChoice& backend, const RunControl& control) {
  // Before a device is opened.
  check(light_field);
  options.check();
  return Estimator::of(backend).reconstruct(light_field, options, control);
}

Reconstruction Estimator::reconstruct(const LightField& light_field, const DepthOptions& options,
                                      const RunControl& control) const {
  return control.stop_or_fail([&] {
    return with_memory_errors("depth", [&] { return compute(light_field, options, control); });
  });
}

Reconstruction Estimator::compute(const LightField& light_field, const DepthOptions& options,
                                  const RunControl& control) const {
  return Reconstruction(run(light_field, options, control));
}

CoarseGuide Estimator::find_guide(const LightField& seen, const DepthOptions& options,
                                  const RunControl& control) const {
  DepthOptions coarse = options;
  coarse.disparity.reset();  // every camera has its own
  if (coarse.hypotheses > 0) coarse.hypotheses = std::max(coarse.hypotheses / 2, 2);
  coarse.score.remove_jpeg_blocks = false;
  coarse.score.even_exposures = false;
  coarse.keep_searches = false;
  coarse.memory_beside += kept_picture_bytes(seen, options);
  const LightField half = halved(seen);
  const RunControl part(control, std::to_string(half.width) + "x" + std::to_string(half.height));
  auto found = run(half, coarse, part);
  return CoarseGuide(std::move(found->maps));
}

std::unique_ptr<Reconstruction::Impl> Estimator::run(const LightField& light_field,
                                                     const DepthOptions& options,
                                                     const RunControl& control) const {
  auto impl = std::make_unique<Reconstruction::Impl>();
  LightField seen;
  std::vector<std::string> jobs;  ///< before and after the pictures were looked at
  std::vector<std::unique_ptr<Workspace>> workspaces;
  std::optional<CoarseGuide> guide;
  {
    const StageTimer timer(impl->seconds, "prepare");
    check(light_field);
    LightField given = kept_and_cleaned(light_field, options, control);
    DepthOptions wanted = options;
    require_direction(given, wanted, control);
    Prepared run = prepare(given, wanted, control);
    impl->light_field = std::move(given);
    impl->light_field.pixels = light_field.pixels;
    if (devices_.empty()) {
      impl->plan = plan_run(run, std::nullopt, kHost);
      adapt_to_pictures(run, control);
    } else {
      std::string selection;
      std::vector<DeviceInfo> infos;
      for (const Device& device : devices_) {
        selection += (selection.empty() ? "" : ",") + device.selection();
        infos.push_back(device.info());
      }
      jobs.push_back(kernel_job(run, selection));
      impl->plan = plan_run(run, selection, limits_of(infos));
      adapt_to_pictures(run, control);
      jobs.push_back(kernel_job(run, selection));
      if (!opencl::kernels_are_ready(jobs.back()))
        control.message(std::string("compiling kernels for this device") +
                        (opencl::cache_folder() ? ", once" : ""));
    }
    seen = run.light_field;
    impl->options = run.options;
    if (impl->plan.guided) guide = find_guide(seen, wanted, control);
    impl->hypotheses = run.hypotheses;
    impl->cameras = seen.cameras;
    impl->sampler = make_sampler(seen);
    if (devices_.empty()) workspaces.push_back(make_workspace(run, nullptr));
    for (const Device& device : devices_) workspaces.push_back(make_workspace(run, &device));
  }
  for (const auto& workspace : workspaces)
    impl->device += impl->device.empty() ? workspace->name() + ": " + workspace->description()
                                         : "; " + workspace->description();
  RunResult result = run_pipeline(
      {seen, impl->options, impl->hypotheses, impl->plan, control, guide ? &*guide : nullptr},
      workspaces);
  for (const std::string& job : jobs) opencl::note_ready_kernels(job);
  workspaces.clear();
  impl->maps = std::move(result.maps);
  impl->searches = std::move(result.searches);
  impl->active = active_views(seen, impl->options);
  impl->views = impl->active;
  std::sort(impl->views.begin(), impl->views.end());
  impl->tuples = std::move(result.tuples);
  impl->seconds.merge(result.seconds);
  if (const auto* posed = std::get_if<UnstructuredSampler>(&*impl->sampler);
      posed && impl->options.propagation.consensus && impl->active.size() > 1) {
    const StageTimer timer(impl->seconds, "agreement");
    impl->maps = view_consensus(*posed, impl->active, std::move(impl->maps),
                                impl->hypotheses.step(), impl->plan.work_folder, control);
    impl->agreed = true;
  }
  return impl;
}

Forecast forecast(const LightField& light_field, const DepthOptions& options,
                  const BackendChoice& backend) {
  return with_memory_errors("a forecast", [&] {
    const Prepared run =
        prepare(kept_and_cleaned(light_field, options, RunControl{}), options, RunControl{});
    if (backend.backend == "reference") return plan_run(run, std::nullopt, kHost).forecast;
    const std::string devices = opencl::stated_device(backend.device);
    return plan_run(run, joined(devices), limits_of(devices)).forecast;
  });
}

double least_memory_bytes(const LightField& light_field, const DepthOptions& options) {
  return with_memory_errors("a forecast", [&] {
    const Prepared run =
        prepare(kept_and_cleaned(light_field, options, RunControl{}), options, RunControl{});
    return least_memory_limit(run.light_field, widest(run.options), run.hypotheses, limits_of(""));
  });
}

}  // namespace gigaray
