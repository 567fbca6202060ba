// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The steps around the score. What a pixel is differs: see `what` below. Bytes are what a kernel
// must read and write once; a kernel that reads its neighbours again from a cache moves more than
// that.
#include <functional>
#include <memory>

#include "kernels/kernel_benchmarks.h"
#include "support/program.h"

namespace gigaray::benchmarks {
namespace {

struct Step {
  const char* kernel;
  const char* what;  ///< What is counted: shown in the name.
  bool paper;        ///< Preset whose variant of the kernel it is.
  double (*pixels)(const KernelCase&);
  double bytes_per_pixel;
};

double view_pixels(const KernelCase& step) { return step.pixels() * step.num_views(); }
double pixels(const KernelCase& step) { return step.pixels(); }
double scores(const KernelCase& step) { return step.pixels() * step.shape().hypotheses; }

constexpr Step kSteps[] = {
    // 3 bytes in, 3 or 5 floats out.
    {"unpack_channels", "view-pixels", true, view_pixels, 3 + 12},
    {"unpack_channels", "view-pixels", false, view_pixels, 3 + 20},
    {"edge_confidence", "pixels", true, pixels, 12 + 4},
    {"score_support", "scores", false, scores, 4 + 4},
    {"winner", "scores", true, scores, 4},
    {"bilateral_median", "pixels", true, pixels, 12 + 4 + 4},  // 11 x 11
    {"mean_radiance", "view-pixels", true, view_pixels, 12},
    // Colours of the other view, estimate read and written.
    {"propagation", "view-pixels", true, view_pixels, 12 + 8 + 8},
    {"downsample", "view-pixels", true, view_pixels, 12 + 3},
};

double copy_limit() {
  static const double limit = machine().copy_bytes_per_second();
  return limit;
}

void declare(const Step& step) {
  TrialShape shape;
  shape.views_s = 50;
  shape.height = 96;
  DepthOptions options = step.paper ? paper_options() : auto_options();
  options.score.bandwidth = 0.1f;
  options.score.gradient_bandwidth = 0.02f;
  auto kernel = std::make_shared<KernelCase>(step.kernel, shape, options);
  const auto run = [kernel, step](benchmark::State& state) {
    kernel->make_ready();
    for (auto _ : state) kernel->run();
    using benchmark::Counter;
    const double done = step.pixels(*kernel) * double(state.iterations());
    state.counters["M/s"] = Counter(done * 1e-6, Counter::kIsRate);
    state.counters["GB/s"] = Counter(done * step.bytes_per_pixel * 1e-9, Counter::kIsRate);
    state.counters["copy GB/s"] = copy_limit() * 1e-9;
  };
  const std::string name =
      std::string(step.kernel) + (step.paper ? "/paper/" : "/auto/") + step.what;
  repeated(benchmark::RegisterBenchmark(name.c_str(), run))->Unit(benchmark::kMillisecond);
}

}  // namespace

void declare_other_steps() {
  for (const Step& step : kSteps) declare(step);
}

}  // namespace gigaray::benchmarks
