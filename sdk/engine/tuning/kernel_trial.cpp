// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "tuning/kernel_trial.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "gigaray/core/synthetic.h"

namespace gigaray {
namespace {

/// As in the tests of parity: rounding, and what mean-shift makes of it.
double tolerance_of(const std::string& kernel) {
  if (kernel == "bilateral_median") return 0;  // picks a value
  if (kernel == "density_score" || kernel == "robust_score" || kernel == "score_support" ||
      kernel == "slanted_support" || kernel == "scanline" || kernel == "winner" ||
      kernel == "mean_radiance" || kernel == "slope_fit")
    return 1e-4;
  return 4e-6;
}

SyntheticLightField render(const TrialShape& shape) {
  SyntheticOptions scene;
  scene.width = shape.width;
  scene.height = shape.height;
  scene.views_s = shape.views_s;
  scene.views_t = shape.views_t;
  scene.disparity = shape.disparity;
  scene.noise = 0.02;  // as in photographs, no two samples are alike
  scene.samples = 1;
  return render_synthetic(scene, RunControl{});
}

template <class T>
void append(std::vector<float>& values, const StripMap<T>& map, RowRange rows) {
  static_assert(sizeof(T) % sizeof(float) == 0);
  for (int v = rows.begin; v < rows.end; ++v) {
    const auto* begin = reinterpret_cast<const float*>(map.row(v));
    values.insert(values.end(), begin, begin + map.width() * (sizeof(T) / sizeof(float)));
  }
}

}  // namespace

const std::vector<std::string>& KernelTrial::kernels() {
  static const std::vector<std::string> names = {
      "unpack_channels", "edge_confidence", "density_score", "robust_score", "score_support",
      "slope_fit",       "slanted_support", "scanline",      "winner",       "bilateral_median",
      "mean_radiance",   "propagation",     "downsample"};
  return names;
}

TrialShape KernelTrial::check_shape(const TrialShape& shape) {
  TrialShape small = shape;
  small.width = 37;
  small.height = 17;
  small.hypotheses = 16;
  return small;
}

KernelTrial::KernelTrial(const TrialShape& shape, const DepthOptions& options)
    : shape_(shape), sampler_(EpiSampler(std::vector<View>{})) {
  const SyntheticLightField scene = render(shape);
  const LightField& light_field = scene.light_field;
  sampler_ = make_sampler(light_field);
  setup_ = {options,
            {shape.disparity.min, shape.disparity.max, shape.hypotheses},
            light_field.kind,
            light_field.pixels->bit_depth()};
  ref_ = centre_view(light_field);

  const int width = shape.width, height = shape.height, views = light_field.num_views();
  const std::size_t line = std::size_t(width) * 3;
  encoded_.resize(std::size_t(height) * views * line);
  for (int view = 0; view < views; ++view) {
    const Image<std::uint16_t> picture = light_field.pixels->read(view);
    for (int v = 0; v < height; ++v)
      std::copy_n(picture.row(v), line, encoded_.begin() + (std::size_t(v) * views + view) * line);
  }

  todo_ = StripMap<std::uint8_t>(width, rows());
  bounds_ = StripMap<HypothesisBounds>(width, rows());
  disparity_ = confidence_ = StripMap<float>(width, rows());
  radiance_ = StripMap<Radiance>(width, rows());
  slopes_ = StripMap<Slope>(width, rows());
  const HypothesisBounds full{0, std::uint16_t(shape.hypotheses - 1)};
  const double step = setup_.hypotheses.step();
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* own = &encoded_[(std::size_t(v) * views + ref_) * line];
    for (int u = 0; u < width; ++u) {
      todo_.row(v)[u] = 1;
      bounds_.row(v)[u] = full;
      // The truth, off by up to two hypotheses, with holes.
      const int disorder = (u * 7 + v * 13) % 11;
      const float truth = scene.disparity[ref_](u, v);
      disparity_.row(v)[u] = disorder == 0 ? kNoEstimate : float(truth + (disorder % 5 - 2) * step);
      confidence_.row(v)[u] = 0.01f * float(disorder);
      slopes_.row(v)[u] = {0.2f * float(step) * float(disorder - 5), 0.1f * float(step)};
      radiance_.row(v)[u] = {own[3 * u] / 255.0f, own[3 * u + 1] / 255.0f, own[3 * u + 2] / 255.0f};
    }
  }
}

std::unique_ptr<TrialBench> KernelTrial::make_bench(std::unique_ptr<Workspace> workspace) const {
  auto bench = std::make_unique<TrialBench>();
  Workspace& device = *workspace;
  bench->workspace = std::move(workspace);
  device.set_active_views(all_views(num_views()));
  device.begin_level({0, shape_.width, shape_.height}, shape_.height);
  const auto make = [&]<class T>(const StripMap<T>& from, Map<T>& to) {
    to = device.make_map<T>(shape_.width, rows());
    if (from.rows() == rows()) device.put(from, to);
  };
  make(todo_, bench->todo);
  make(bounds_, bench->bounds);
  make(disparity_, bench->disparity);
  make(confidence_, bench->confidence);
  make(radiance_, bench->radiance);
  make(slopes_, bench->slopes);
  make(StripMap<float>(), bench->map);
  make(StripMap<float>(), bench->second_map);
  make(StripMap<Radiance>(), bench->mean_radiance);
  make(StripMap<Slope>(), bench->fitted_slopes);
  bench->pixels.pixels = {device.allocate(encoded_.size()), 0, num_views()};
  bench->pixels.at = all_views(num_views());
  device.write(*bench->pixels.pixels.memory, std::as_bytes(std::span(encoded_)));
  const std::size_t rows_of_views = std::size_t(shape_.height) * num_views();
  bench->estimates = {device.allocate(rows_of_views * shape_.width * sizeof(PackedEstimate)), 0,
                      num_views()};
  bench->small = {device.allocate(rows_of_views * 3 * shape_.width * sizeof(float)), 0,
                  num_views()};
  load(*bench);
  device.hold_scores(0, rows());
  return bench;
}

void KernelTrial::load(TrialBench& bench) const {
  bench.workspace->load_band(rows(), rows(), all_views(num_views()), bench.pixels);
}

std::unique_ptr<TrialBench> KernelTrial::reference() const {
  return make_bench(
      std::visit([&](const auto& s) { return make_reference_workspace(s, setup_); }, sampler_));
}

std::unique_ptr<TrialBench> KernelTrial::opencl(const Device& device,
                                                const opencl::TuningOverrides& overrides) const {
  return make_bench(std::visit(
      [&](const auto& s) {
        return opencl::make_tuned_workspace(s, setup_, device.opened(), overrides);
      },
      sampler_));
}

void KernelTrial::prepare(TrialBench& bench, const std::string& kernel) const {
  Workspace& steps = *bench.workspace;
  if (kernel == "score_support" || kernel == "slanted_support" || kernel == "scanline" ||
      kernel == "winner") {
    if (setup_.options.score.gradient)
      steps.robust_score(ref_, rows(), bench.todo, bench.bounds, ScoreViews::kAll);
    else
      steps.density_score(ref_, rows(), bench.todo, bench.bounds);
  }
  if (kernel == "scanline") steps.score_support(ref_, rows(), bench.todo, bench.bounds);
  steps.finish();
}

void KernelTrial::run(TrialBench& bench, const std::string& kernel) const {
  const DepthOptions& options = setup_.options;
  Workspace& steps = *bench.workspace;
  if (kernel == "unpack_channels")
    load(bench);
  else if (kernel == "edge_confidence")
    steps.edge_confidence(ref_, rows(), bench.map);
  else if (kernel == "density_score")
    steps.density_score(ref_, rows(), bench.todo, bench.bounds);
  else if (kernel == "robust_score")
    steps.robust_score(ref_, rows(), bench.todo, bench.bounds, ScoreViews::kAll);
  else if (kernel == "scanline")
    steps.scanline(ref_, rows(), bench.todo);
  else if (kernel == "score_support")
    steps.score_support(ref_, rows(), bench.todo, bench.bounds);
  else if (kernel == "slanted_support")
    steps.slanted_support(ref_, rows(), bench.todo, bench.bounds, bench.slopes);
  else if (kernel == "slope_fit")
    steps.slope_fit(ref_, rows(), bench.todo, bench.disparity, bench.fitted_slopes);
  else if (kernel == "winner")
    steps.winner(rows(), bench.todo, bench.bounds, bench.map, bench.second_map);
  else if (kernel == "bilateral_median")
    steps.bilateral_median(ref_, rows(), options.winner.median_radius,
                           options.winner.median_tolerance, bench.disparity, bench.map);
  else if (kernel == "mean_radiance")
    steps.mean_radiance(ref_, rows(), bench.disparity, bench.mean_radiance);
  else if (kernel == "propagation")
    steps.propagation(ref_, rows(), bench.disparity, bench.confidence, bench.radiance, rows(), 0,
                      {}, bench.estimates);
  else
    steps.downsample({0, (shape_.height + 1) / 2}, bench.small, 0);
  steps.finish();
}

std::vector<float> KernelTrial::output(TrialBench& bench, const std::string& kernel) const {
  Workspace& steps = *bench.workspace;
  std::vector<float> values;
  const auto add = [&](const auto& map) { append(values, steps.get(map), rows()); };
  if (kernel == "density_score" || kernel == "robust_score" || kernel == "score_support" ||
      kernel == "slanted_support") {
    for (int v = 0; v < shape_.height; ++v)
      for (int u = 0; u < shape_.width; ++u) {
        const std::vector<float> scores = steps.scores_at(u, v);
        values.insert(values.end(), scores.begin(), scores.end());
      }
  } else if (kernel == "scanline") {  // what it leaves shows in the winners
    steps.winner(rows(), bench.todo, bench.bounds, bench.map, bench.second_map);
    add(bench.map);
  } else if (kernel == "winner") {
    add(bench.map);
    add(bench.second_map);
  } else if (kernel == "slope_fit") {
    add(bench.fitted_slopes);
  } else if (kernel == "mean_radiance") {
    add(bench.mean_radiance);
    for (int i = 0, v = 0; v < shape_.height; ++v)  // undefined where there is no estimate
      for (int u = 0; u < shape_.width; ++u, i += 3)
        if (std::isnan(disparity_.row(v)[u])) std::fill_n(values.begin() + i, 3, kNoEstimate);
  } else if (kernel == "propagation") {
    std::vector<PackedEstimate> estimates(bench.estimates.memory->bytes() / sizeof(PackedEstimate));
    steps.read(*bench.estimates.memory, std::as_writable_bytes(std::span(estimates)));
    for (const PackedEstimate estimate : estimates) {
      values.push_back(hypothesis_of(estimate));
      values.push_back(confidence_of(estimate));
    }
  } else if (kernel == "downsample" || kernel == "unpack_channels") {
    // The band can't be read.
    if (kernel == "unpack_channels") steps.downsample({0, (shape_.height + 1) / 2}, bench.small, 0);
    values.resize(std::size_t((shape_.height + 1) / 2) * num_views() * 3 *
                  ((shape_.width + 1) / 2));
    steps.read(*bench.small.memory, std::as_writable_bytes(std::span(values)));
  } else {
    add(bench.map);
  }
  return values;
}

std::vector<float> KernelTrial::answer(TrialBench& bench, const std::string& kernel) const {
  prepare(bench, kernel);
  run(bench, kernel);
  return output(bench, kernel);
}

Agreement KernelTrial::compare(const std::string& kernel, const std::vector<float>& expected,
                               const std::vector<float>& actual) {
  GIGARAY_CHECK(expected.size() == actual.size() && !expected.empty());
  const double tolerance = tolerance_of(kernel);
  Agreement agreement;
  std::size_t apart = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i]) || std::isnan(actual[i])) {
      apart += std::isnan(expected[i]) != std::isnan(actual[i]);
      continue;
    }
    const double difference = std::abs(double(expected[i]) - double(actual[i]));
    agreement.largest = std::max(agreement.largest, difference);
    apart += difference > tolerance;
  }
  agreement.share_apart = double(apart) / double(expected.size());
  return agreement;
}

}  // namespace gigaray
