// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Score of all hypotheses. A sample-iteration is one colour sample of one view through one
// mean-shift iteration or through the score: pixels x hypotheses x views x (iterations + 1) of
// them. The time holds everything: sampling, the division of every iteration, and writing the
// scores.
#include <algorithm>
#include <chrono>
#include <memory>

#include "kernels/kernel_benchmarks.h"
#include "support/program.h"

namespace gigaray::benchmarks {
namespace {

struct Rig {
  int views_s, views_t;
};

std::string name_of(const char* kernel_and_preset, const Rig& rig) {
  return std::string(kernel_and_preset) + (rig.views_t > 1 ? "/4D/" : "/3D/") +
         std::to_string(rig.views_s * rig.views_t);
}

TrialShape shape_of(const Rig& rig) {
  TrialShape shape;
  shape.views_s = rig.views_s;
  shape.views_t = rig.views_t;
  shape.hypotheses = 256;
  return shape;
}

/// The paper's score with all its iterations. The bandwidth is such that the mean of every pixel
/// really moves in every iteration: the kernel stops where nothing moves any more, and the rate
/// would count work that was not done.
DepthOptions every_iteration(int iterations) {
  DepthOptions options = paper_options();
  options.score.bandwidth = 0.04f;
  options.score.stop_early = false;
  options.score.mean_shift_iterations = iterations;
  return options;
}

/// Share of the blocks of 16 pixels in which the last iteration changed a score: a block goes on as
/// long as one of its pixels moves.
double changed_by_last_iteration(const TrialShape& shape, int iterations) {
  const TrialShape small = KernelTrial::check_shape(shape);
  const auto scores = [&](int count) {
    KernelTrial trial(small, every_iteration(count));
    return trial.answer(*trial.opencl(Device::open()), "density_score");  // [v][u][hypothesis]
  };
  const auto all = scores(iterations), fewer = scores(iterations - 1);
  constexpr int kBlock = 16;
  int blocks = 0, changed = 0;
  for (int v = 0; v < small.height; ++v)
    for (int begin = 0; begin + kBlock <= small.width; begin += kBlock)
      for (int i = 0; i < small.hypotheses; ++i) {
        bool any = false;
        for (int u = begin; u < begin + kBlock; ++u) {
          const std::size_t at = (std::size_t(v) * small.width + u) * small.hypotheses + i;
          any = any || all[at] != fewer[at];
        }
        ++blocks;
        changed += any;
      }
  return double(changed) / blocks;
}

/// Times one case with the machine's limit measured just before and just after.
/// fma_per_sample: multiply-adds per sample-iteration that the kernel can't do without.
void time_score(benchmark::State& state, KernelCase& score, int passes, double fma_per_sample) {
  using Clock = std::chrono::steady_clock;
  const double before = machine().fma_per_second();
  const auto begin = Clock::now();
  for (auto _ : state) score.run();
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const double after = machine().fma_per_second();
  const double rate = score.pixels() * score.shape().hypotheses * score.num_views() * passes *
                      double(state.iterations()) / seconds;
  state.counters["G sample-iterations/s"] = rate * 1e-9;
  state.counters["G FMA/s before"] = before * 1e-9;
  state.counters["G FMA/s after"] = after * 1e-9;
  state.counters["share of FMA limit"] = rate * fma_per_sample / std::max(before, after);
}

void declare_paper(const Rig& rig) {
  constexpr int kIterations = 10;
  // Mean-shift: 1 difference, 3 fused and a maximum for the kernel, 1 sum and 3 fused for the mean:
  // 6 multiply-adds of 9 operations. The score: 3 of 6.
  constexpr double kFma = (6.0 * kIterations + 3.0) / (kIterations + 1);
  auto score =
      std::make_shared<KernelCase>("density_score", shape_of(rig), every_iteration(kIterations));
  const auto run = [score](benchmark::State& state) {
    if (score->make_ready() && changed_by_last_iteration(score->shape(), kIterations) < 0.98)
      throw Error(ErrorCode::kDevice,
                  "mean-shift comes to rest before its last iteration: the rate "
                  "would count work that was not done");
    time_score(state, *score, kIterations + 1, kFma);
  };
  repeated(benchmark::RegisterBenchmark(name_of("density_score/paper", rig).c_str(), run))
      ->Unit(benchmark::kMillisecond);
}

void declare_auto(const Rig& rig) {
  // 5 channels of 4 taps, in 4D of 4 such rows and their 4 weights; the distances 3 + 2, the
  // kernels
  // 5. The kernel leaves the gradients out where no colour fits, so the share can exceed 1.
  const double taps = rig.views_t > 1 ? 5 * (4 * 4 + 4) : 5 * 4;
  DepthOptions options = auto_options();
  options.score.bandwidth = 0.1f;
  options.score.gradient_bandwidth = 0.02f;
  auto score = std::make_shared<KernelCase>("robust_score", shape_of(rig), options);
  const auto run = [score, taps](benchmark::State& state) {
    score->make_ready();
    time_score(state, *score, 1, taps + 10);
  };
  repeated(benchmark::RegisterBenchmark(name_of("robust_score/auto", rig).c_str(), run))
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void declare_density_score() {
  for (const Rig& rig : {Rig{9, 1}, Rig{50, 1}, Rig{81, 1}, Rig{100, 1}, Rig{3, 3}, Rig{10, 5},
                         Rig{9, 9}, Rig{10, 10}})
    declare_paper(rig);
  for (const Rig& rig : {Rig{81, 1}, Rig{9, 9}}) declare_auto(rig);
}

}  // namespace gigaray::benchmarks
