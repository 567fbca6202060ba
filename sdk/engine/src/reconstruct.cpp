// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "gigaray/scene_estimates.h"
#include "pipeline.h"
#include "stage_timer.h"

namespace gigaray {
namespace {

/// Hypotheses for a range: as many as asked for, or one every step.
HypothesisRange sample_range(const DepthOptions& options, const LightField& light_field) {
  const DisparityRange& range = *options.disparity;
  const double farthest = std::max(std::abs(range.min), std::abs(range.max));
  std::ostringstream text;
  text << "disparity range " << range.min << " " << range.max;
  if (farthest >= light_field.width)
    throw Error(ErrorCode::kInvalidArgument,
                text.str() + ": wider than the pictures (" + std::to_string(light_field.width) +
                    " px), neighbouring views share nothing then");
  double count = options.hypotheses;
  if (count == 0) count = std::ceil((range.max - range.min) / options.hypothesis_step) + 1;
  if (count > 4096)
    throw Error(ErrorCode::kInvalidArgument,
                text.str() + ": takes " + std::to_string(long(count)) +
                    " hypotheses, 4096 is the most; give a narrower range or fewer hypotheses");
  return {range.min, range.max, std::max(int(count), 2)};
}

struct Prepared {
  DepthOptions options;
  HypothesisRange hypotheses;
};

/// Checks the input and fills in what the options leave to the data.
Prepared prepare(const LightField& light_field, const DepthOptions& wanted,
                 const RunControl& control, bool read_pixels) {
  check(light_field);
  wanted.check();
  Prepared run{wanted, {}};
  for (const int view : wanted.views)
    if (view < 0 || view >= light_field.num_views())
      throw Error(ErrorCode::kInvalidArgument, "view " + std::to_string(view) + ": there are views 0 … " +
                                                   std::to_string(light_field.num_views() - 1));
  if (!run.options.disparity) run.options.disparity = light_field.declared_range;
  if (!run.options.disparity) {
    // A guess of usual size stands in where no pixel may be read: it moves the forecast a little.
    run.options.disparity = read_pixels ? estimate_disparity_range(light_field, control).range
                                        : DisparityRange{-2, 2};
    if (read_pixels) {
      std::ostringstream text;
      text << "disparity range " << run.options.disparity->min << " … " << run.options.disparity->max
           << " px per view step, estimated from the pictures";
      control.message(text.str());
    }
  }
  run.hypotheses = sample_range(run.options, light_field);
  run.options.hypotheses = run.hypotheses.count;
  if (run.options.score.from_noise && read_pixels)
    apply_noise(estimate_noise(light_field, run.hypotheses, control), run.options);
  return run;
}

std::unique_ptr<Backend> make_backend(const LightField& light_field, const Prepared& run,
                                      const BackendChoice& choice) {
  const BackendSetup setup{run.options, run.hypotheses, light_field.kind,
                           light_field.pixels->bit_depth()};
  return std::visit(
      [&](const auto& sampler) -> std::unique_ptr<Backend> {
        if (choice.backend == "reference") return make_reference_backend(sampler, setup);
        if (choice.backend == "opencl") return make_opencl_backend(sampler, setup, choice.device);
        throw Error(ErrorCode::kInvalidArgument,
                    "backend " + choice.backend + ": there are opencl and reference");
      },
      make_sampler(light_field));
}

}  // namespace

struct Reconstruction::Impl {
  DepthOptions options;
  HypothesisRange hypotheses;
  MemoryPlan plan;
  std::unique_ptr<Backend> backend;
  std::string device;
  std::vector<int> views;   ///< ascending
  std::vector<int> active;  ///< as processed
  std::vector<LevelState> levels;
  TupleStore tuples{""};
  std::map<std::string, double> seconds;
};

Reconstruction::Reconstruction(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Reconstruction::Reconstruction(Reconstruction&&) noexcept = default;
Reconstruction& Reconstruction::operator=(Reconstruction&&) noexcept = default;
Reconstruction::~Reconstruction() = default;

const DepthOptions& Reconstruction::options() const { return impl_->options; }
const HypothesisRange& Reconstruction::hypotheses() const { return impl_->hypotheses; }
const std::vector<int>& Reconstruction::views() const { return impl_->views; }
int Reconstruction::num_levels() const { return int(impl_->levels.size()); }
const std::string& Reconstruction::device() const { return impl_->device; }
const std::map<std::string, double>& Reconstruction::seconds() const { return impl_->seconds; }
const Forecast& Reconstruction::forecast() const { return impl_->plan.forecast; }
std::size_t Reconstruction::num_tuples() const { return impl_->tuples.size(); }
void Reconstruction::for_each_tuple(const std::function<void(const RayTuple&)>& visit) const {
  impl_->tuples.for_each(visit);
}

ViewDepth Reconstruction::view(int view_idx) {
  const StageTimer timer(impl_->seconds, "fill");
  const auto found = std::find(impl_->active.begin(), impl_->active.end(), view_idx);
  if (found == impl_->active.end())
    throw Error(ErrorCode::kInvalidArgument,
                "view " + std::to_string(view_idx) + " was not asked for, it has no depth");
  const std::size_t active = found - impl_->active.begin();

  // From the coarsest level down: an own estimate, else that of the coarse pixel above.
  ViewDepth result;
  std::vector<PackedEstimate> row;
  for (int level = num_levels() - 1; level >= 0; --level) {
    const LevelState& state = impl_->levels[level];
    const int width = state.shape.width, height = state.shape.height;
    const ViewDepth coarse = std::move(result);
    result = {FloatMap(width, height, 1, kNoEstimate), FloatMap(width, height, 1, kNoEstimate),
              Image<std::int8_t>(width, height, 1, std::int8_t(-1))};
    row.resize(width);
    for (int v = 0; v < height; ++v) {
      state.estimates.read(v, active * width * sizeof(PackedEstimate), width * sizeof(PackedEstimate),
                           row.data());
      for (int u = 0; u < width; ++u) {
        if (row[u] != 0) {
          result.disparity(u, v) = hypothesis_of(row[u]);
          result.confidence(u, v) = confidence_of(row[u]);
          result.level(u, v) = std::int8_t(level);
        } else if (!coarse.disparity.empty()) {
          result.disparity(u, v) = coarse.disparity(u / 2, v / 2);
          result.confidence(u, v) = coarse.confidence(u / 2, v / 2);
          result.level(u, v) = coarse.level(u / 2, v / 2);
        }
      }
    }
  }

  const int radius = impl_->options.propagation.final_median_radius;
  if (radius == 0) return result;
  const int width = result.disparity.width(), height = result.disparity.height();
  const RowRange all{0, height};
  StripMap<float> in(width, all), out(width, all);
  for (int v = 0; v < height; ++v) std::copy_n(result.disparity.row(v), width, in.row(v));
  impl_->backend->begin_level({0, width, height});
  impl_->backend->bilateral_median(view_idx, all, radius, std::numeric_limits<float>::infinity(), in,
                                   out);
  for (int v = 0; v < height; ++v) std::copy_n(out.row(v), width, result.disparity.row(v));
  return result;
}

Reconstruction reconstruct(const LightField& light_field, const DepthOptions& options,
                           const BackendChoice& backend, const RunControl& control) {
  auto impl = std::make_unique<Reconstruction::Impl>();
  {
    const StageTimer timer(impl->seconds, "prepare");
    const Prepared run = prepare(light_field, options, control, true);
    impl->options = run.options;
    impl->hypotheses = run.hypotheses;
    impl->plan = plan_memory(light_field, run.options, run.hypotheses);
    impl->backend = make_backend(light_field, run, backend);
  }
  impl->device = impl->backend->name() + ": " + impl->backend->description();
  Pipeline pipeline(light_field, impl->options, impl->hypotheses, impl->plan, *impl->backend, control);
  pipeline.run();
  impl->levels = std::move(pipeline.levels());
  impl->active = pipeline.active_views();
  impl->views = impl->active;
  std::sort(impl->views.begin(), impl->views.end());
  impl->tuples = std::move(pipeline.tuples());
  impl->seconds.merge(pipeline.seconds());
  return Reconstruction(std::move(impl));
}

Forecast forecast(const LightField& light_field, const DepthOptions& options) {
  const Prepared run = prepare(light_field, options, RunControl{}, false);
  return plan_memory(light_field, run.options, run.hypotheses).forecast;
}

}  // namespace gigaray
