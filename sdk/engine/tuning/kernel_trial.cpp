// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "tuning/kernel_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "gigaray/synthetic.h"

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
  disparity_ = confidence_ = map_ = second_map_ = StripMap<float>(width, rows());
  radiance_ = mean_radiance_ = StripMap<Radiance>(width, rows());
  slopes_ = fitted_slopes_ = StripMap<Slope>(width, rows());
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
  estimates_.resize(std::size_t(height) * views * width);
  small_.resize(std::size_t(height + 1) / 2 * views * 3 * ((width + 1) / 2));
}

void KernelTrial::load(Backend& backend) const {
  backend.load_band(rows(), all_views(num_views()), encoded_.data(), BandEncoding::kBits8, nullptr);
}

std::unique_ptr<Backend> KernelTrial::reference() const {
  auto backend =
      std::visit([&](const auto& s) { return make_reference_backend(s, setup_); }, sampler_);
  std::vector<int> active(num_views());
  std::iota(active.begin(), active.end(), 0);
  backend->set_active_views(active);
  backend->begin_level({0, shape_.width, shape_.height});
  load(*backend);
  return backend;
}

std::unique_ptr<Backend> KernelTrial::opencl(const std::string& device,
                                             const opencl::TuningOverrides& overrides) const {
  auto backend = std::visit(
      [&](const auto& s) { return opencl::make_tuned_backend(s, setup_, device, overrides); },
      sampler_);
  std::vector<int> active(num_views());
  std::iota(active.begin(), active.end(), 0);
  backend->set_active_views(active);
  backend->begin_level({0, shape_.width, shape_.height});
  load(*backend);
  return backend;
}

void KernelTrial::prepare(Backend& backend, const std::string& kernel) const {
  if (kernel == "score_support" || kernel == "slanted_support" || kernel == "scanline" ||
      kernel == "winner") {
    if (setup_.options.score.gradient)
      backend.robust_score(ref_, rows(), todo_, bounds_, ScoreViews::kAll);
    else
      backend.density_score(ref_, rows(), todo_, bounds_);
  }
  if (kernel == "scanline") backend.score_support(ref_, rows(), todo_, bounds_);
}

void KernelTrial::run(Backend& backend, const std::string& kernel) {
  const DepthOptions& options = setup_.options;
  if (kernel == "unpack_channels")
    load(backend);
  else if (kernel == "edge_confidence")
    backend.edge_confidence(ref_, rows(), map_);
  else if (kernel == "density_score")
    backend.density_score(ref_, rows(), todo_, bounds_);
  else if (kernel == "robust_score")
    backend.robust_score(ref_, rows(), todo_, bounds_, ScoreViews::kAll);
  else if (kernel == "scanline")
    backend.scanline(ref_, rows(), todo_);
  else if (kernel == "score_support")
    backend.score_support(ref_, rows(), todo_, bounds_);
  else if (kernel == "slanted_support")
    backend.slanted_support(ref_, rows(), todo_, bounds_, slopes_);
  else if (kernel == "slope_fit")
    backend.slope_fit(ref_, rows(), disparity_, fitted_slopes_);
  else if (kernel == "winner")
    backend.winner(rows(), todo_, bounds_, map_, second_map_);
  else if (kernel == "bilateral_median")
    backend.bilateral_median(ref_, rows(), options.winner.median_radius,
                             options.winner.median_tolerance, disparity_, map_);
  else if (kernel == "mean_radiance")
    backend.mean_radiance(ref_, rows(), disparity_, mean_radiance_);
  else if (kernel == "propagation")
    backend.propagation(ref_, rows(), disparity_, confidence_, radiance_, rows(), nullptr,
                        estimates_.data());
  else
    backend.downsample({0, (shape_.height + 1) / 2}, small_.data());
}

std::vector<float> KernelTrial::output(Backend& backend, const std::string& kernel) {
  std::vector<float> values;
  if (kernel == "density_score" || kernel == "robust_score" || kernel == "score_support" ||
      kernel == "slanted_support") {
    for (int v = 0; v < shape_.height; ++v)
      for (int u = 0; u < shape_.width; ++u) {
        const std::vector<float> scores = backend.scores_at(u, v);
        values.insert(values.end(), scores.begin(), scores.end());
      }
  } else if (kernel == "scanline") {  // what it leaves shows in the winners
    backend.winner(rows(), todo_, bounds_, map_, second_map_);
    append(values, map_, rows());
  } else if (kernel == "winner") {
    append(values, map_, rows());
    append(values, second_map_, rows());
  } else if (kernel == "slope_fit") {
    append(values, fitted_slopes_, rows());
  } else if (kernel == "mean_radiance") {
    append(values, mean_radiance_, rows());
    for (int i = 0, v = 0; v < shape_.height; ++v)  // undefined where there is no estimate
      for (int u = 0; u < shape_.width; ++u, i += 3)
        if (std::isnan(disparity_.row(v)[u])) std::fill_n(values.begin() + i, 3, kNoEstimate);
  } else if (kernel == "propagation") {
    for (const PackedEstimate estimate : estimates_) {
      values.push_back(hypothesis_of(estimate));
      values.push_back(confidence_of(estimate));
    }
  } else if (kernel == "downsample") {
    values = small_;
  } else if (kernel == "unpack_channels") {
    backend.downsample({0, (shape_.height + 1) / 2}, small_.data());  // the band can't be read
    values = small_;
  } else {
    append(values, map_, rows());
  }
  return values;
}

std::vector<float> KernelTrial::answer(Backend& backend, const std::string& kernel) {
  std::fill(estimates_.begin(), estimates_.end(), 0);
  prepare(backend, kernel);
  run(backend, kernel);
  return output(backend, kernel);
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
