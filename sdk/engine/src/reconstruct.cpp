// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>

#include "coarse_guide.h"
#include "few_views.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/jpeg_blocks.h"
#include "gigaray/core/kept_pictures.h"
#include "gigaray/core/smoothing.h"
#include "gigaray/engine/device.h"
#include "gigaray/engine/estimator.h"
#include "gigaray/engine/exposures.h"
#include "gigaray/engine/scene_estimates.h"
#include "inverse_depths.h"
#include "make_workspace.h"
#include "opencl/cache_folder.h"
#include "opencl/device.h"
#include "opencl/ready_kernels.h"
#include "reconstruction_impl.h"
#include "run.h"
#include "settle_direction.h"
#include "stage_timer.h"
#include "view_consensus.h"

namespace gigaray {
namespace {

/// Hypotheses for a range: as many as asked for, or one every step.
HypothesisRange sample_range(const DepthOptions& options, const LightField& light_field) {
  const DisparityRange& range = *options.disparity;
  const double farthest = std::max(std::abs(range.min), std::abs(range.max));
  std::ostringstream text;
  text << "disparity range " << range.min << " " << range.max;
  if (range.max - range.min < 1e-3)
    throw Error(ErrorCode::kInvalidArgument, text.str() + ": too narrow to be sampled");
  if (farthest >= light_field.width)
    throw Error(ErrorCode::kInvalidArgument, text.str() + ": wider than the pictures (" +
                                                 std::to_string(light_field.width) +
                                                 " px), neighbouring views share nothing then");
  double count = options.hypotheses;
  if (count == 0) {
    count = std::ceil((range.max - range.min) / options.hypothesis_step) + 1;
    if (options.score.from_noise && most_others(light_field) <= kMostFewViews)
      count = std::min(count, double(kMostOfFewViews));
  }
  if (count > 4096)
    throw Error(ErrorCode::kInvalidArgument,
                text.str() + ": takes " + std::to_string(long(count)) +
                    " hypotheses, 4096 is the most; give a narrower range or fewer hypotheses");
  return {range.min, range.max, std::max(int(count), 2)};
}

/// The pictures as the engine sees them, each read and cleaned once.
LightField kept_and_cleaned(const LightField& light_field, const DepthOptions& options,
                            const RunControl& control) {
  check(light_field);
  const auto keep = [&](const LightField& pictures) {
    return KeptPictures::over(std::make_shared<KeptPictures>(options.memory_bytes), pictures);
  };
  LightField kept = keep(light_field);
  if (!options.score.remove_jpeg_blocks) return kept;
  LightField cleaned = without_jpeg_blocks(kept);
  if (cleaned.pixels == kept.pixels) return kept;
  control.message("the pictures were JPEG: its blocks are removed before they are compared");
  return keep(cleaned);
}

/// Most that kept_and_cleaned() holds of them.
double kept_picture_bytes(const LightField& light_field, const DepthOptions& options) {
  const double all = 3.0 * light_field.pixels->bit_depth() / 8 * light_field.width *
                     light_field.height * light_field.num_views();
  return std::min(all, KeptPictures::most_bytes(options.memory_bytes));
}

struct Prepared {
  LightField light_field;  ///< as the engine gets to see it
  DepthOptions options;
  HypothesisRange hypotheses;
};

/// Smooths noisy pictures, as little as will do, and sets what the options derive from the noise.
/// Returns the view that told.
int adapt_to_noise(Prepared& run, const RunControl& control) {
  const LightField original = run.light_field;
  NoiseEstimate noise = estimate_noise(original, run.hypotheses, control);
  const double lead = noise.lead;
  run.options.score.ray_mean =
      run.options.score.ray_mean && lead < kLeadOfOwnPixel && noise.colour > kLeastNoise;
  run.options.score.smoothing = 0;
  for (const float sigma : {0.7f, 1.0f}) {
    if (noise.lead >= kLeadWithoutSmoothing) break;
    const LightField smooth = smoothed(original, sigma);
    const NoiseEstimate left = estimate_noise(smooth, run.hypotheses, control);
    if (left.lead <= noise.lead) break;  // it is not noise that hides the answer
    run.light_field = smooth;
    run.options.score.smoothing = sigma;
    noise = left;
  }
  if (run.options.score.smoothing > 0) {
    std::ostringstream text;
    text << "noisy pictures: smoothed by " << run.options.score.smoothing << " px";
    control.message(text.str());
  }
  apply_noise(noise, run.options);
  apply_doubt(ray_doubt(noise, lead, std::max(most_others(original), 1)), run.options);
  return noise.view;
}

std::string range_message(const DisparityRange& range) {
  std::ostringstream text;
  text << "disparity range " << range.min << " … " << range.max
       << " px per view step, estimated from the pictures";
  return text.str();
}

/// Finds which way the camera goes where that is only assumed, and takes the range that it had to
/// estimate for that. Mirrored depth would look finished.
void require_direction(LightField& light_field, DepthOptions& options, const RunControl& control) {
  const auto settled = settle_direction(light_field, control);
  if (!settled) return;
  if (!settled->is_clear)
    throw Error(ErrorCode::kInvalidArgument,
                "which way the camera goes is only assumed, and disparities of both signs don't "
                "tell: state OpenOptions::direction, or take the assumption "
                "by sign_is_assumed = false");
  if (!settled->message.empty()) control.message(settled->message);
  if (options.disparity) return;
  options.disparity = settled->range;
  control.message(range_message(settled->range));
}

/// Range and hypotheses of parallel views.
void prepare_range(Prepared& run, const RunControl& control) {
  if (!run.options.disparity) run.options.disparity = run.light_field.declared_range;
  if (!run.options.disparity) {
    run.options.disparity = estimate_disparity_range(run.light_field, control).range;
    control.message(range_message(*run.options.disparity));
  }
  run.hypotheses = sample_range(run.options, run.light_field);
}

/// The same of unstructured views: each searches its own range of inverse depths.
void prepare_unstructured(Prepared& run, const RunControl& control) {
  run.light_field.most_partners = run.options.most_partners;
  set_inverse_depths(run.light_field, run.options, control);
  const InverseDepthRange all = all_inverse_depths(run.light_field.cameras);
  run.options.disparity = DisparityRange{all.min, all.max};
  check_partners(
      run.light_field,
      run.options.views.empty() ? all_views(run.light_field.num_views()) : run.options.views,
      control);
  const double travel = usual_travel(run.light_field);
  const int count =
      run.options.hypotheses > 0 ? run.options.hypotheses : count_hypotheses(travel, run.options);
  adapt_to_posed_views((count - 1) / std::max(travel, 1.0), run.options);
  run.hypotheses = {0, 1, count};
}

/// Checks the input and fills in what decides the memory. Reads pictures where the range has to be
/// estimated.
Prepared prepare(const LightField& light_field, const DepthOptions& wanted,
                 const RunControl& control) {
  check(light_field);
  wanted.check();
  Prepared run{light_field, wanted, {}};
  for (const int view : wanted.views)
    if (view < 0 || view >= light_field.num_views())
      throw Error(ErrorCode::kInvalidArgument, "view " + std::to_string(view) +
                                                   ": there are views 0 … " +
                                                   std::to_string(light_field.num_views() - 1));
  if (light_field.kind == LightFieldKind::kUnstructured) {
    prepare_unstructured(run, control);
  } else {
    prepare_range(run, control);
    run.options.propagation.consensus = false;
  }
  run.options.hypotheses = run.hypotheses.count;
  adapt_to_few_views(run.light_field, run.options);
  return run;
}

/// With all that the pictures may ask for.
DepthOptions widest(DepthOptions options) {
  if (options.score.from_noise && options.support.radius > 0) apply_doubt(1, options);
  return options;
}

/// Takes out the exposures of posed photographs where they differ.
void even_exposures(Prepared& run, const RunControl& control) {
  const std::vector<Exposure> exposures = estimate_exposures(run.light_field, control);
  if (!differ(exposures)) return;
  float least = 0;
  for (const Exposure& exposure : exposures)
    least = std::min(least, *std::min_element(exposure.begin(), exposure.end()));
  std::ostringstream text;
  text.precision(2);
  text << "exposures differ, the darkest picture is " << std::exp(least)
       << " of the brightest: evened out before pictures are compared";
  control.message(text.str());
  run.light_field = evened(run.light_field, exposures);
}

/// Fills in what the pictures decide. The plan of the memory comes before: it holds for all
/// pictures, so that the forecast, which looks at none, and the run say the same.
void adapt_to_pictures(Prepared& run, const RunControl& control) {
  if (run.options.score.even_exposures && run.light_field.kind == LightFieldKind::kUnstructured)
    even_exposures(run, control);
  if (run.options.score.from_noise) {
    const int view = adapt_to_noise(run, control);
    if (most_others(run.light_field) <= kMostFewViews)
      widen(estimate_window_noise(run.light_field, view, run.hypotheses, control), run.options);
  } else if (run.options.score.smoothing > 0)
    run.light_field = smoothed(run.light_field, run.options.score.smoothing);
}

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

/// device: null: the reference.
std::unique_ptr<Workspace> make_workspace(const Prepared& run, const Device* device) {
  const WorkspaceSetup setup{run.options, run.hypotheses, run.light_field.kind,
                             run.light_field.pixels->bit_depth()};
  return std::visit(
      [&](const auto& sampler) {
        return device ? make_opencl_workspace(sampler, setup, device->opened())
                      : make_reference_workspace(sampler, setup);
      },
      make_sampler(run.light_field));
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

ScoreCurve probe(const LightField& light_field, const DepthOptions& options,
                 const BackendChoice& backend, int view_idx, int u, int v,
                 const RunControl& control) {
  // Before a device is opened.
  check(light_field);
  options.check();
  return Estimator::of(backend).probe(light_field, options, view_idx, u, v, control);
}

ScoreCurve Estimator::probe(const LightField& light_field, const DepthOptions& options,
                            int view_idx, int u, int v, const RunControl& control) const {
  return control.stop_or_fail([&] {
    return with_memory_errors("the scores of a pixel", [&] {
      return compute_curve(light_field, options, view_idx, u, v, control);
    });
  });
}

ScoreCurve Estimator::compute_curve(const LightField& light_field, const DepthOptions& options,
                                    int view_idx, int u, int v, const RunControl& control) const {
  const int width = light_field.width, height = light_field.height;
  if (view_idx < 0 || view_idx >= light_field.num_views() || u < 0 || u >= width || v < 0 ||
      v >= height)
    throw Error(ErrorCode::kInvalidArgument, "pixel " + std::to_string(u) + " " +
                                                 std::to_string(v) + " is outside the picture of " +
                                                 std::to_string(width) + "x" +
                                                 std::to_string(height));
  check(light_field);
  LightField given = kept_and_cleaned(light_field, options, control);
  DepthOptions wanted = options;
  require_direction(given, wanted, control);
  Prepared run = prepare(given, wanted, control);
  adapt_to_pictures(run, control);
  const auto workspace = make_workspace(run, devices_.empty() ? nullptr : &devices_.front());
  const AnySampler sampler = make_sampler(run.light_field);
  const std::vector<int> partners =
      std::visit([&](const auto& s) { return s.partners(view_idx); }, sampler);

  // The rows that the pixel's window reaches in any view, all views.
  constexpr int kTaps = 3;  // interpolation and gradients
  const int radius = run.options.support.radius;
  const RowRange strip = grown({v, v + 1}, radius, height);
  const RowRange rows = std::visit(
      [&](const auto& s) {
        return s.rows_needed(view_idx, grown(strip, kTaps, height), run.hypotheses, height);
      },
      sampler);
  const std::size_t line = std::size_t(width) * 3, loaded = partners.size();
  std::vector<std::uint16_t> encoded(rows.size() * loaded * line);
  std::vector<std::uint8_t> mask(light_field.pixels->has_mask() ? encoded.size() / 3 : 0);
  for (std::size_t i = 0; i < loaded; ++i) {
    control.progress("decode", double(i), double(loaded));
    Image<std::uint16_t> picture = read_view(run.light_field, partners[i]);
    const auto shown = take_mask(picture);
    for (int y = rows.begin; y < rows.end; ++y) {
      const std::size_t at = std::size_t(y - rows.begin) * loaded + i;
      std::copy_n(picture.row(y), line, encoded.begin() + at * line);
      if (shown) std::copy_n(shown->row(y), width, mask.begin() + at * width);
    }
  }
  std::vector<std::uint8_t> bytes;
  if (run.light_field.pixels->bit_depth() == 8) bytes.assign(encoded.begin(), encoded.end());
  const auto to_device = [&](auto& values) {
    RowsOnDevice to{workspace->allocate(values.size() * sizeof values[0]), rows.begin, int(loaded)};
    workspace->write(*to.memory, std::as_bytes(std::span(values)));
    return to;
  };
  EncodedRows source;
  source.at = all_views(int(loaded));
  source.encoding = bytes.empty() ? BandEncoding::kBits16 : BandEncoding::kBits8;
  source.pixels = bytes.empty() ? to_device(encoded) : to_device(bytes);
  if (!mask.empty()) source.shown = {to_device(mask), width, 0};
  workspace->begin_level({0, width, height}, rows.size());
  workspace->load_band(rows, rows, partners, source);

  // The window around the pixel is to do, with all hypotheses; maps are of the whole view.
  const RowRange all{0, height};
  const auto todo = workspace->make_map<std::uint8_t>(width, all);
  const auto bounds = workspace->make_map<HypothesisBounds>(width, all);
  const HypothesisBounds full{0, std::uint16_t(run.hypotheses.count - 1)};
  StripMap<std::uint8_t> window(width, strip);
  StripMap<HypothesisBounds> tested(width, strip);
  for (int y = strip.begin; y < strip.end; ++y)
    for (int x = std::max(u - radius, 0); x <= std::min(u + radius, width - 1); ++x) {
      window.row(y)[x] = 1;
      tested.row(y)[x] = full;
    }
  workspace->put(window, todo);
  workspace->put(tested, bounds);
  workspace->hold_scores(0, strip);
  if (run.options.score.gradient)
    workspace->robust_score(view_idx, strip, todo, bounds, ScoreViews::kAll);
  else
    workspace->density_score(view_idx, strip, todo, bounds);
  const RowRange row{v, v + 1};
  if (radius > 0) workspace->score_support(view_idx, row, todo, bounds);
  const auto disparity = workspace->make_map<float>(width, row);
  const auto contrast = workspace->make_map<float>(width, row);
  workspace->winner(row, todo, bounds, disparity, contrast);

  ScoreCurve curve;
  curve.scores = workspace->scores_at(u, v);
  const float winner = workspace->get(disparity).row(v)[u];
  curve.confidence = workspace->get(contrast).row(v)[u];
  const float most = float((1 << run.light_field.pixels->bit_depth()) - 1);
  const Radiance unseen{kNoEstimate, kNoEstimate, kNoEstimate};
  curve.samples.assign(light_field.views.size(), unseen);
  for (std::size_t i = 0; i < loaded; ++i) {
    const auto there = std::visit(
        [&](const auto& s) {
          return s.locate(view_idx, partners[i], Ray{double(u), double(v), winner});
        },
        sampler);
    if (!there ||
        !(there->u >= 0 && there->u <= width - 1 && there->v >= 0 && there->v <= height - 1))
      continue;
    const std::size_t x = std::size_t(std::lround(there->u)),
                      y = std::size_t(std::lround(there->v));
    const std::uint16_t* pixel = &encoded[((y - rows.begin) * loaded + i) * line + 3 * x];
    curve.samples[partners[i]] = {pixel[0] / most, pixel[1] / most, pixel[2] / most};
  }
  // In the caller's unit.
  curve.hypotheses = run.hypotheses;
  curve.disparity = winner;
  if (!run.light_field.cameras.empty()) {
    const InverseDepthRange& range = *run.light_field.cameras[view_idx].inverse_depth;
    curve.hypotheses = {range.min, range.max, run.hypotheses.count};
    curve.disparity = float(range.min + winner * (range.max - range.min));
  }
  return curve;
}

}  // namespace gigaray
